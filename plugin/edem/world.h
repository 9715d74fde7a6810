// All that a solver holds: plain data, on which the stages work.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edem/body.h"
#include "edem/books.h"
#include "edem/drift.h"
#include "edem/pair_lists.h"
#include "edem/resting_loads.h"
#include "edem/rigid_contacts.h"
#include "edem/solver_def.h"
#include "edem/stages.h"
#include "edem/step_length.h"

namespace rubble::edem {

template <class Real>
struct World {
  SolverDef def;
  std::vector<std::unique_ptr<Body<Real>>> bodies;  ///< those of the ticks, rising in their ids
  /// Those that are lent to the host (parking.h), of which no tick knows but what they hold in all [kg], [J].
  std::vector<std::unique_ptr<Body<Real>>> parked;
  double parkedMass = 0, parkedElastic = 0;
  PairLists<Real> lists;
  RigidContacts<Real> rigid;
  RestingLoads resting;
  StepLength<Real> stepLength;
  double contactShare = 1;  ///< of the stiffness that bodies ask for in contacts: as stiff as substeps allow
  bool listsStale = true;
  Drifts drifts;                                      ///< since the last listing
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< of the last tick [m/s^2]
  double lastStep = 0;  ///< of the positions; 0 before the first, and while all lies still [s]
  TickReport report;    ///< of the last tick
  Books books;
  std::string failure;  ///< empty: none
};

}  // namespace rubble::edem
