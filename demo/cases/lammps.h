// LAMMPS, where it is installed, as a peer: one granular sphere (its package GRANULAR) and a wall.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "demo/report_case.h"

namespace rubble::demo {

/// Whether the PATH has a program `lmp`.
bool hasLammps();

/// Names of expressions of its input language, "xcm(all,x)", whose values a run ends with.
struct LammpsRun {
  std::string script;  ///< all up to the steps
  std::vector<std::string> asked;
  double timestep;   ///< [s]
  double simulated;  ///< [s]
};

struct LammpsResult {
  std::vector<double> values;   ///< of what was asked
  double processorSeconds = 0;  ///< of its steps, as it says itself
};

/// Runs it in a folder of its own, on one core. Throws MachineError, with LAMMPS' own words, where it fails.
LammpsResult runLammps(const LammpsRun& run);

/// What a log of such a run ends with; throws MachineError if it has none, with its line of the error.
LammpsResult readLammpsLog(const std::string& log, std::size_t asked);

/// A sphere in a box without limits in the way of its motion, above a wall y = 0 with a spring of that
/// stiffness [N/m] and a dashpot of that rate [1/s] against it; with memory of what slid it holds by friction
/// 1. Lengths in metres, [kg/m^3].
struct LammpsSphere {
  double x, y, radius, density;
  double stiffness, damping;
  bool friction;
};
std::string lammpsScript(const LammpsSphere& sphere);

/// Runs of `method` at each timestep, none where LAMMPS is not installed; `run` takes the timestep [s].
std::vector<CaseRun> lammpsRuns(const std::string& method, std::initializer_list<double> timesteps,
                                const std::function<CaseOutcome(double)>& run);

}  // namespace rubble::demo
