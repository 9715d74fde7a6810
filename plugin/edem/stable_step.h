// The safe explicit substep.
#pragma once

#include <span>

#include "edem/body.h"

namespace rubble::edem {

/// Stiffness and damping that one element sees, divided by its mass and inertia.
struct ElementRates {
  double stiffness = 0;  ///< s_i [1/s^2]
  double damping = 0;    ///< [1/s]
};

/// s_i = sum over springs of k / m_i + (k |d0|^2 / 4 + k_rot) / I_i, and the same sum over the dashpots.
template <class Real>
void springRates(const Body<Real>& body, std::span<ElementRates> rates);

/// The same of what is awake; nothing of the rest.
template <class Real>
void awakeSpringRates(const Body<Real>& body, std::span<ElementRates> rates);

/// Bound of the highest frequency: max over unbroken springs of s_i + s_j (a fixed end: 0), by splitting each
/// mass over its springs and bounding each spring alone (Irons and Treharne 1971). Elements without springs
/// count s_i alone.
struct RateBound {
  double frequency2 = 0;  ///< omega^2 <= [1/s^2]
  double damping = 0;     ///< gamma <= [1/s]
  void add(const ElementRates& a, const ElementRates& b);
  void add(const RateBound& other);
  /// Largest stable step of symplectic Euler with lagged damping: h = 2 / omega (sqrt(1 + xi^2) - xi), xi =
  /// gamma / (2 omega).
  double stableStep() const;
};

/// Rates of one side of a contact by its law: of the normal spring, or of sliding and rolling together, which
/// are at right angles to it.
ElementRates contactRates(const ContactLaw<double>& law, double inverseMass, double inverseInertia,
                          double radius);

template <class Real>
RateBound springBound(const Body<Real>& body, std::span<const ElementRates> rates);

}  // namespace rubble::edem
