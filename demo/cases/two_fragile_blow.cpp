// The bundled scene `two_fragile`: wall and ball both break.
#include "demo/cases/cases.h"
#include "demo/cases/scene_case.h"

namespace rubble::demo {

ReportCase twoFragileBlowCase() {
  return sceneCase({.name = "two_fragile_blow",
                    .what =
                        "The scene two_fragile after 0.3 s: a ball of 256 elements has struck a wall of 2048 "
                        "at 10 m/s, and both break",
                    .scene = "two_fragile",
                    .frames = 18,
                    .minutes = 5,
                    .frameSeconds = 0.4,
                    .objects = 2,
                    .wholeBodies = true,
                    .fewInAll = true});
}

}  // namespace rubble::demo
