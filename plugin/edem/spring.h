// The pore spring (paper 3.1.2, eq. 3) written as an energy, so that force and torque agree and both momenta
// are kept.
//
//        I            d0             K          d  = rest vector I -> K in the body's frame, turned with the
//        frame o--------------------------->o          dx = gap between the two elements' ends of the spring:
//         \__ a_I __/ \__ a_K __/                 (x_K - x_I) - R_I (d0 / 2 + o) - R_K (d0 / 2 - o)
//
//   U = k/2 |dx|^2 + k_rot (1 - cos phi),  phi the relative rotation.
//
// Everything is differences from the body's rigid frame: displacements u, relative rotations R' (see body.h),
// so that float keeps its digits for the strain. DEVIATION: k_rot is not in the paper; without it a lone
// chain has no stiffness in bending. DEVIATION: the spring acts at its face's centroid, o from the middle of
// d0, not only across it. Then forces and torques of a packing balance in any even strain (the cells' faces
// close), so that its modulus and its tractions are those of the solid: an elastically homogeneous
// rigid-body-spring network [BolanderSaito98]. At the middle they turn the cells, which softens the packing
// and overloads single springs. Model::rotationalStiffness switches both off (k_rot = 0, o = 0).
#pragma once

#include "edem/types.h"

namespace rubble::edem {

/// Constants of one spring. Written at load; `rest` again whenever the body's frame turns.
template <class Real>
struct Spring {
  std::uint32_t first;     ///< element I
  std::uint32_t second;    ///< element K; an anchor's own element I again (its far end does not move)
  Vec3<Real> rest;         ///< d0 turned with the frame [m]
  Vec3<Real> offset;       ///< from the middle of d0 to where the spring acts, turned likewise [m]
  Real stiffness;          ///< k [N/m]
  Real rotational;         ///< k_rot [N m]
  Real damping;            ///< dashpot beside k [N s/m]
  Real rotationalDamping;  ///< dashpot beside k_rot [N m s]
  Real area;               ///< shared face [m^2]
};

/// Motion of one end of a spring.
template <class Real>
struct SpringEnd {
  Vec3<Real> displacement = Vec3<Real>::Zero();  ///< u [m]
  Quat<Real> turn = Quat<Real>::Identity();      ///< R'
  Vec3<Real> velocity = Vec3<Real>::Zero();      ///< [m/s]
  Vec3<Real> spin = Vec3<Real>::Zero();          ///< [rad/s]
};

/// What a spring does now. Forces on I; those on K are the opposite, except the torque arms.
template <class Real>
struct SpringLoad {
  Vec3<Real> gap;            ///< dx [m]
  Vec3<Real> axis;           ///< rest vector as the two ends now turn it [m]; not normalised
  Vec3<Real> elastic;        ///< force on I, k dx [N]
  Vec3<Real> damping;        ///< dashpot force on I [N]
  Vec3<Real> armFirst;       ///< a_I [m]
  Vec3<Real> armSecond;      ///< a_K [m]
  Vec3<Real> elasticTorque;  ///< k_rot sin(phi) n on I; the opposite on K [N m]
  Vec3<Real> dampingTorque;  ///< on I [N m]
  Real stretchEnergy;        ///< k/2 |dx|^2 [J]: the terms of eq. (3)
  Real rotationEnergy;       ///< k_rot (1 - cos phi) [J]
  Real halfAngleSine2;       ///< sin^2(phi / 2)
  Real power;                ///< elastic force . rate of the gap + torque . rate of phi = -dU/dt [W]
};

/// Force, torque and energy of one spring.
///
/// The arms end where the two halves meet (each holds half of dx), so arm_I + arm_K = x_K - x_I: then the
/// dashpot keeps the angular momentum too and does not brake a rigid rotation of a stretched spring.
template <class Real>
SpringLoad<Real> springLoad(const Spring<Real>& spring, const SpringEnd<Real>& first,
                            const SpringEnd<Real>& second) {
  SpringLoad<Real> load;
  const Vec3<Real> half = Real(0.5) * spring.rest;
  const Vec3<Real> restFirst = half + spring.offset, restSecond = half - spring.offset;
  const Vec3<Real> turnFirst = turned(first.turn, restFirst);
  const Vec3<Real> turnSecond = turned(second.turn, restSecond);
  load.gap = (second.displacement - first.displacement) - (turnFirst + turnSecond);
  load.axis = spring.rest + (turnFirst + turnSecond);
  load.armFirst = restFirst + turnFirst + Real(0.5) * load.gap;
  load.armSecond = restSecond + turnSecond + Real(0.5) * load.gap;

  const Vec3<Real> gapRate =
      second.velocity - first.velocity - first.spin.cross(load.armFirst) - second.spin.cross(load.armSecond);
  load.elastic = spring.stiffness * load.gap;
  load.damping = spring.damping * gapRate;
  load.stretchEnergy = Real(0.5) * spring.stiffness * load.gap.squaredNorm();

  // Relative rotation q_K conj(q_I) = (sigma, e), e = sin(phi/2) n: the torque k_rot sin(phi) n = 2 k_rot
  // sigma e needs no inverse trigonometry, and e is a difference of two small numbers only through their own
  // rounding.
  const Vec3<Real> a = first.turn.vec();
  const Vec3<Real> b = second.turn.vec();
  const Vec3<Real> e = first.turn.w() * b - second.turn.w() * a + a.cross(b);
  const Real sigma = first.turn.w() * second.turn.w() + a.dot(b);
  const Vec3<Real> spinRate = second.spin - first.spin;
  load.halfAngleSine2 = e.squaredNorm();
  load.elasticTorque = (Real(2) * spring.rotational * sigma) * e;
  load.dampingTorque = spring.rotationalDamping * spinRate;
  load.rotationEnergy = Real(2) * spring.rotational * load.halfAngleSine2;
  load.power = -load.elastic.dot(gapRate) - load.elasticTorque.dot(spinRate);
  return load;
}

}  // namespace rubble::edem
