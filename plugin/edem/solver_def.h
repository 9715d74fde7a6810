// What a solver is made with.
#pragma once

namespace rubble::edem {

struct SolverDef {
  double substepSafety = 0.9;       ///< share of the stable substep that is used
  int maxSubstepsPerFrame = 20000;  ///< in 1/60 s; a body that needs more is refused
  bool breaking = true;
  bool crushing = true;
};

}  // namespace rubble::edem
