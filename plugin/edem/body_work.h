// Work space of the ticks and substeps of a body.
#pragma once

#include <cstdint>
#include <vector>

#include "edem/types.h"
#include "rubble/events.h"

namespace rubble::edem {

/// Rigid motion of one fragment, and what its contacts do to it in this substep (fragment_motion.h).
struct FragmentMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of mass, world [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of it [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< [rad/s]
  double inverseMass = 0;                              ///< 0 where an anchor holds it [1/kg]
  Eigen::Matrix3d inverseInertia = Eigen::Matrix3d::Zero();
  bool fixed = false;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< about the centre [N m]
  double pressing = 0;                               ///< sum of the sizes of its contacts' forces [N]
  double pressed = 0;                                ///< the same in the last substep [N]

  Eigen::Vector3d velocityAt(const Eigen::Vector3d& world) const {
    return velocity + spin.cross(world - centre);
  }
};

template <class Real>
struct BodyWork {
  // What is stepped, in rising order; written by listAwake. Elements that were crushed and springs that broke
  // since may be in them.
  std::vector<std::uint32_t> awake;         ///< elements that live and do not sleep
  std::vector<std::uint32_t> awakeSprings;  ///< unbroken springs and anchors of those

  // Of the frames and fragments.
  std::vector<Vec3<double>> rest;           ///< origin_f + turn_f X_I, relative to origin; by turnRest [m]
  std::vector<FragmentMotion> motions;      ///< of the fragments; by beginMotions
  std::vector<std::uint32_t> awakeMotions;  ///< those of what is stepped; the others stand as they were
  std::uint32_t numberedBroken = 0, numberedCrushed = 0;  ///< counts when `motionOf` was written
  std::vector<std::uint32_t> motionOf;                    ///< each element's place in `motions`

  // Of a tick.
  std::vector<std::uint8_t> frozen;  ///< 1 for elements that stand still until it ends (frozen.h)

  // Of a substep.
  std::vector<Vec3<double>> position;                   ///< rest + u, relative to origin [m]
  std::vector<Vec3<Real>> force, torque;                ///< all [N], [N m]
  std::vector<Vec3<Real>> dampingForce, dampingTorque;  ///< the part of force and torque that is lost energy
  Wrench base, baseDamping;  ///< of the anchors' base at their far ends, about the origin of their frame:
                             ///< all, and the part that is lost energy
  Wrench dampedByBase;       ///< what damping gave what the base holds, after the substeps, likewise [N s]
  std::vector<Real> load;    ///< W_I, eq. (3) [J]
  std::vector<std::uint32_t> overloaded;    ///< springs to break in this substep
  std::vector<BreakMode> overloadMode;      ///< why, beside `overloaded`
  std::vector<std::uint32_t> crushing;      ///< elements that leave at the end of this substep
  std::vector<std::uint8_t> leaving;        ///< 1 for those
  std::vector<std::uint8_t> springListed;   ///< marks of markCrushed; all 0 between calls
  std::vector<std::uint16_t> touchesBegun;  ///< at each element since the substep was chosen
};

}  // namespace rubble::edem
