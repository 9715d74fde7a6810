// How long a substep may be, so that every spring, every contact that is there and every contact that can
// begin before the next listing is stable in it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "edem/body.h"
#include "edem/pair_lists.h"
#include "edem/rigid_contacts.h"
#include "edem/solver_def.h"
#include "edem/stable_step.h"

namespace rubble::edem {

/// Largest step that follows a blow of this frequency^2 [1/s^2] well enough for its energy [s].
double blowStep(double frequency2);

template <class Real>
class StepLength {
 public:
  /// Takes the rates of the springs. In a tick they only break, so that these stay a bound.
  void beginTick(std::span<const std::unique_ptr<Body<Real>>> bodies);

  /// The bound over springs, over contacts that are there, and over one more at each element that has
  /// something near; for a light rigid body, over all that is near it. Once a second contact has begun at an
  /// element (Body::touchesBegun), the bound must be made anew. Tells `rigid` how stiff light bodies may be.
  void bound(std::span<const std::unique_ptr<Body<Real>>> bodies, const PairLists<Real>& lists,
             RigidContacts<Real>& rigid);

  /// Largest stable step under the last bound [s], and the body that sets it (place).
  double stable() const { return m_bound.stableStep(); }
  /// Largest step that follows a single contact through its blow well enough for its energy [s].
  double resolving() const;
  std::uint32_t stiffest() const { return m_stiffest; }
  struct Place {
    std::uint32_t body = 0, element = kNoElement;
    double step = 0;  ///< stable for it by itself, with all that acts on it [s]
  };
  /// So many awake elements, or all on which anything acts, that need the shortest steps; shortest first.
  std::vector<Place> stiffestElements(std::span<const std::unique_ptr<Body<Real>>> bodies,
                                      std::size_t count) const;

 private:
  void weighRides(std::span<const std::unique_ptr<Body<Real>>> bodies, const RigidContacts<Real>& rigid);
  void addRides(std::span<const std::unique_ptr<Body<Real>>> bodies, const RigidContacts<Real>& rigid);
  void addContact(std::uint32_t place, std::uint32_t element, const ElementRates& one, bool touching);
  void add(std::uint32_t place, const ElementRates& a, const ElementRates& b);

  std::vector<std::vector<ElementRates>> m_springs, m_rates;  // by body
  std::vector<ElementRates>
      m_rides;  // of dynamic bodies by the anchors that ride on them, beside the proxies
  std::vector<std::uint32_t>
      m_sleepers;  // ids of bodies that sleep as a whole, at their places; else kNoPair
  std::vector<std::vector<ElementRates>> m_next;  // of the contact that may begin at each element
  RateBound m_bound;
  double m_contact2 = 0;  // largest frequency^2 of two sides on one contact [1/s^2]
  std::uint32_t m_stiffest = 0;
};

/// Throws rubble::Error when a body's stable `step` [s] makes more substeps than a frame may have, and says
/// how many would do.
template <class Real>
void requireStep(const Body<Real>& body, const Material& material, double step, const SolverDef& def);

extern template class StepLength<float>;
extern template class StepLength<double>;

}  // namespace rubble::edem
