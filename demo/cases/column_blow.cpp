// The bundled scene `column`: a rigid ball shoots the shaft away.
#include "demo/cases/cases.h"
#include "demo/cases/scene_case.h"

namespace rubble::demo {

ReportCase columnBlowCase() {
  // Its elements from the start: the blow is all that happens.
  return sceneCase(
      {.name = "column_blow",
       .what = "The scene column after 0.3 s: a ball of 33.9 kg has gone at 10 m/s through a shaft of 0.26 m",
       .scene = "column",
       .frames = 18,
       .minutes = 5,
       .frameSeconds = 0.4,
       .fewInAll = true});
}

}  // namespace rubble::demo
