// The stages of one substep, in their order. Each is a free function on plain arrays; tick.cpp calls them.
// Those that decide read constants and state and write work space; applyBreaks, integrate and removeCrushed
// change the state.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/crushed_element.h"
#include "edem/body.h"
#include "edem/books.h"
#include "edem/pair_lists.h"
#include "edem/resting_loads.h"
#include "rubble/events.h"

namespace rubble::edem {

struct BrokenSpring {
  std::uint32_t body, spring;
  BreakMode mode;
  double energy;             ///< released [J]
  Eigen::Vector3d position;  ///< [m]
};

/// What one tick did, besides moving things.
struct TickReport {
  int substeps = 0;
  double substep = 0;        ///< h [s]
  double kicked = 0;         ///< time for which forces acted: that of the velocities, between half steps [s]
  double listing = 0;        ///< wall time spent on candidate lists [ms]
  std::string warning;       ///< what the tick could not do as it should; empty: nothing
  std::uint32_t frozen = 0;  ///< elements that stood still until the tick ended (frozen.h)
  std::vector<BrokenSpring> broken;
  /// Without maxRadius, which is the law of another layer.
  std::vector<base::CrushedElement> crushed;
};

/// Sets forces, loads and overload lists to nothing and refreshes positions, of what is awake.
template <class Real>
void beginSubstep(const BodyState<Real>& state, BodyWork<Real>& work);

/// Springs: force, torque, load W_I (eq. 3) and which springs are over their limit (decides, changes
/// nothing). `kick` is the time over which the forces will act [s]. Returns the elastic energy [J].
template <class Real>
double accumulateSprings(const Body<Real>& body, BodyWork<Real>& work, double kick, bool breaking,
                         Books& books);

/// Element contacts of one list (paper 3.1.2), of one body or two; their energy goes into list.elastic.
template <class Real>
void accumulateContacts(PairList<Real>& list, Body<Real>& a, Body<Real>& b, const Steps& steps,
                        RestingLoads& resting, Books& books);

/// Marks the elements whose load passes the limit of eq. (4): fills work.leaving and adds their springs to
/// the overloaded ones.
template <class Real>
void markCrushed(const Body<Real>& body, BodyWork<Real>& work);

/// Takes the contacts of leaving elements out of this substep, as applyBreaks does with springs.
template <class Real>
void releaseContacts(PairList<Real>& list, Body<Real>& a, Body<Real>& b, double step, double kick,
                     RestingLoads& resting, Books& books);

/// Takes the overloaded springs out: their force of this substep, their place in the graph, their energy into
/// books.fracture.
template <class Real>
void applyBreaks(Body<Real>& body, std::uint32_t place, double kick, PairLists<Real>& lists, Books& books,
                 TickReport& report);

/// Symplectic Euler (eq. 1, 2): velocities over `kick`, then positions over `step` [s]. Adds mass, momentum
/// and kinetic energy of the body to the books' state. Returns the largest squared distance from `listed` +
/// `drifted` [m^2], NaN if anything is not finite.
template <class Real>
Real integrate(Body<Real>& body, double kick, double step, const Eigen::Vector3d& gravity,
               std::span<const Vec3<double>> listed, const Eigen::Vector3d& drifted, Books& books);

/// Moves what the anchors hold to, and books its work of the substep.
template <class Real>
void moveBase(Body<Real>& body, double kick, double step, Books& books);

/// Leaving elements leave, with their share of the energy of report.broken[brokenBegin..].
template <class Real>
void removeCrushed(Body<Real>& body, std::size_t brokenBegin, Books& books, TickReport& report);

}  // namespace rubble::edem
