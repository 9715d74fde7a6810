// When a pore spring breaks.
#pragma once

#include <cmath>

#include "edem/spring.h"
#include "rubble/events.h"
#include "rubble/material.h"

namespace rubble::edem {

inline constexpr double kPi = 3.14159265358979323846;
/// Past a quarter turn the torque k_rot sin(phi) falls again: the law says nothing there, and no material
/// that is held by its strength gets that far [rad].
inline constexpr double kLargestAngle = kPi / 2;

// A face of area A is judged as a square of edge a = sqrt(A).
/// Largest normal stress by a bending moment M: M (a/2) / (a^4/12) = 6 M / a^3.
inline constexpr double kBendingStress = 6;
/// Largest shear stress by a torque T, in the middle of the edges: T / (0.208 a^3) [TimoshenkoGoodier70,
/// 109].
inline constexpr double kTwistStress = 1 / 0.208;

/// Thresholds of one material, ready for use in a substep.
template <class Real>
struct Criterion {
  BreakCriterion kind;
  Real tension;           ///< f_t [Pa]
  Real compression;       ///< f_c [Pa]
  Real cohesion;          ///< c = sqrt(f_c f_t) / 2 [Pa]
  Real internalFriction;  ///< mu_s = (f_c - f_t) / (2 sqrt(f_c f_t)), dimensionless
  Real stretch2;          ///< square of the stretch threshold, dimensionless
  Real halfAngleSine2;    ///< sin^2 of half the relative rotation at which a spring breaks
};

template <class Real>
Criterion<Real> makeCriterion(const Material& material, const Model& model) {
  const double geometric = std::sqrt(material.compressiveStrength * material.tensileStrength);
  const double angle =
      model.breakCriterion == BreakCriterion::Stretch ? material.breakingAngle : kLargestAngle;
  const double sine = std::sin(0.5 * std::fmin(angle, kPi));
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

/// Stresses on a spring's face.
template <class Real>
struct FaceStress {
  Real normal;   ///< mean; > 0 in tension [Pa]
  Real bending;  ///< by which the edge is pulled more than the mean, >= 0 [Pa]
  Real shear;    ///< mean, and of the twist at the edge where the two add up [Pa]
};

template <class Real>
FaceStress<Real> faceStress(const Spring<Real>& spring, const SpringLoad<Real>& load) {
  const Vec3<Real> axis = load.axis.normalized();
  const Real along = load.elastic.dot(axis), twist = load.elasticTorque.dot(axis);
  const Real perForce = Real(1) / spring.area;
  const Real perMoment = perForce / std::sqrt(spring.area);
  // The vectors across are formed first: differences of squares would lose half of a float's digits.
  const Vec3<Real> across = load.elastic - along * axis, bending = load.elasticTorque - twist * axis;
  return {perForce * along, Real(kBendingStress) * perMoment * bending.norm(),
          perForce * across.norm() + Real(kTwistStress) * perMoment * std::fabs(twist)};
}

/// Whether and why the spring breaks. DEVIATION (default): Mohr-Coulomb on the stresses of the face, since
/// under the paper's isotropic threshold (Stretch) oblique springs fail in shear long before the object is
/// crushed, and every element's fracture energy is capped alike. Bending opens the face at its pulled edge;
/// its pressed edge alone breaks nothing, as the rest of the face goes on to carry: pressure is judged by its
/// mean.
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
  const FaceStress<Real> stress = faceStress(spring, load);
  const Real shearLimit = limit.cohesion + limit.internalFriction * std::fmax(Real(0), -stress.normal);
  if (stress.normal + stress.bending > limit.tension) {
    mode = BreakMode::Tension;
  } else if (-stress.normal > limit.compression) {
    mode = BreakMode::Compression;
  } else if (stress.shear > shearLimit) {
    mode = BreakMode::Shear;
  } else {
    return false;
  }
  return true;
}

}  // namespace rubble::edem
