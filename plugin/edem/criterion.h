// When a pore spring breaks.
#pragma once

#include <cmath>

#include "edem/spring.h"
#include "rubble/events.h"
#include "rubble/material.h"

namespace rubble::edem {

/// Thresholds of one material, ready for use in a substep.
template <class Real>
struct Criterion {
  BreakCriterion kind;
  Real tension;           ///< f_t [Pa]
  Real compression;       ///< f_c [Pa]
  Real cohesion;          ///< c = sqrt(f_c f_t) / 2 [Pa]
  Real internalFriction;  ///< mu_s = (f_c - f_t) / (2 sqrt(f_c f_t)), dimensionless
  Real stretch2;          ///< square of the stretch threshold, dimensionless
  Real halfAngleSine2;    ///< sin^2 of half the breaking angle
};

template <class Real>
Criterion<Real> makeCriterion(const Material& material, const Model& model) {
  const double geometric = std::sqrt(material.compressiveStrength * material.tensileStrength);
  const double sine = std::sin(0.5 * std::fmin(material.breakingAngle, 3.14159265358979323846));
  Criterion<Real> c;
  c.kind = model.breakCriterion;
  c.tension = Real(material.tensileStrength);
  c.compression = Real(material.compressiveStrength);
  c.cohesion = Real(0.5 * geometric);
  c.internalFriction = geometric > 0
                           ? Real((material.compressiveStrength - material.tensileStrength) / (2 * geometric))
                           : Real(0);
  c.stretch2 = Real(material.stretchThreshold * material.stretchThreshold);
  c.halfAngleSine2 = Real(sine * sine);
  return c;
}

/// Whether and why the spring breaks. DEVIATION (default): Mohr-Coulomb on the traction t = k dx / A, since
/// under the paper's isotropic threshold (Stretch) oblique springs fail in shear long before the object is
/// crushed, and every element's fracture energy is capped alike.
template <class Real>
bool breaks(const Criterion<Real>& limit, const Spring<Real>& spring, const SpringLoad<Real>& load,
            BreakMode& mode) {
  if (load.halfAngleSine2 > limit.halfAngleSine2) {
    mode = BreakMode::Rotation;
    return true;
  }
  if (limit.kind == BreakCriterion::Stretch) {
    mode = BreakMode::Stretch;
    return load.gap.squaredNorm() > limit.stretch2 * spring.rest.squaredNorm();
  }
  const Real scale = spring.stiffness / spring.area;  // gap -> traction
  const Real length2 = load.axis.squaredNorm();
  const Real along = load.gap.dot(load.axis);
  const Real normal = scale * along / std::sqrt(length2);  // > 0 in tension
  const Real shear2 = scale * scale * std::fmax(Real(0), load.gap.squaredNorm() - along * along / length2);
  const Real shearLimit = limit.cohesion + limit.internalFriction * std::fmax(Real(0), -normal);
  if (normal > limit.tension) {
    mode = BreakMode::Tension;
  } else if (-normal > limit.compression) {
    mode = BreakMode::Compression;
  } else if (shear2 > shearLimit * shearLimit) {
    mode = BreakMode::Shear;
  } else {
    return false;
  }
  return true;
}

}  // namespace rubble::edem
