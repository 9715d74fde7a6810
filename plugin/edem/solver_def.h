// What a solver is made with.
#pragma once

namespace rubble::edem {

struct SolverDef {
  double substepSafety = 0.9;  ///< share of the stable substep that is used
  /// In 1/60 s; a body that needs more is refused, contacts that do are made softer.
  int maxSubstepsPerFrame = 20000;
  bool breaking = true;
  bool crushing = true;
  /// Fragments slower than this, surfaces included, fall asleep one by one, each with what it touches; 0:
  /// none does [m/s].
  double sleepSpeed = 0;
  double sleepTime = 0.5;  ///< after so long [s]
  /// Fragments slower than this for so long, which something bears or they would fall, come to rest: what
  /// they deform by is damped at least at that rate; 0: none do [m/s], [s], [1/s].
  double settleSpeed = 0, settleTime = 0.5, settleRate = 20;
  /// And their motion as a whole at this one, if it does not only grow: pieces of a wall else still rock
  /// after ten seconds, but what topples slowly must fall [1/s].
  double brakeRate = 5;
};

}  // namespace rubble::edem
