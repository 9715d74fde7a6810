// The contact of two elements, or of an element and a rigid surface (paper 3.1.2).
//
//   F_n = -k_cn overlap - eta_cn v_n,  F_t = -eta_ct v_t
//
// DEVIATION: the dashpot never pulls (F_n >= 0), and friction limits |F_t| <= mu |F_n| (mu < 0: no limit, the
// paper).
#pragma once

#include <cassert>
#include <cmath>
#include <limits>

#include "edem/types.h"

namespace rubble::edem {

template <class Real>
struct ContactLaw {
  Real stiffness;  ///< k_cn [N/m]
  Real damping;    ///< eta_cn = eta_ct [N s/m]
  Real friction;   ///< mu; negative: unlimited
};

/// Dashpot constant with the damping ratio `ratio` for the spring `stiffness` between masses of reduced mass
/// `mass`.
template <class Real>
Real dashpot(Real ratio, Real stiffness, Real mass) {
  return Real(2) * ratio * std::sqrt(stiffness * mass);
}

/// Force on the second body at a contact, split into what its energy gives back and what is lost.
template <class Real>
struct ContactForce {
  Vec3<Real> elastic;
  Vec3<Real> damping;
};

/// `normal` points from the first to the second body, `approach` is the velocity of the second relative to
/// the first at the contact point [m/s], `overlap` > 0 [m].
template <class Real>
ContactForce<Real> contactForce(const ContactLaw<Real>& law, Real overlap, const Vec3<Real>& normal,
                                const Vec3<Real>& approach) {
  assert(overlap > 0 && law.stiffness >= 0 && law.damping >= 0);
  assert(std::abs(normal.squaredNorm() - Real(1)) < Real(1e-3));  // unit; looser than any scalar's rounding
  const Real elastic = law.stiffness * overlap;
  const Real normalSpeed = approach.dot(normal);
  const Real total = std::fmax(Real(0), elastic - law.damping * normalSpeed);
  Vec3<Real> tangential = -law.damping * (approach - normalSpeed * normal);
  if (law.friction >= Real(0)) {
    const Real limit = law.friction * total;
    const Real size2 = tangential.squaredNorm();
    if (size2 > limit * limit) tangential *= limit / std::sqrt(size2);
  }
  return {elastic * normal, (total - elastic) * normal + tangential};
}

}  // namespace rubble::edem
