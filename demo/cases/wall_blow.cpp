// The bundled scene `wall`: a rigid ball goes through it.
#include "demo/cases/cases.h"
#include "demo/cases/scene_case.h"

namespace rubble::demo {

ReportCase wallBlowCase() {
  // The ball has left the wall in the twelfth frame.
  return sceneCase(
      {.name = "wall_blow",
       .what = "The scene wall after 0.3 s: a ball of 33.9 kg has gone at 10 m/s through 2048 elements",
       .scene = "wall",
       .frames = 18,
       .minutes = 5,
       .frameSeconds = 0.4,
       .wholeBodies = true});
}

}  // namespace rubble::demo
