// A flat block on level ground, of elements or as Bullet's rigid box: what slides, and what stands on a
// slope.
#pragma once

#include "demo/cases/case_world.h"

namespace rubble::demo::block {

inline constexpr double kFriction = 0.3, kGravity = 9.81;  ///< [-], [m/s^2]

/// 0.4 x 0.1 x 0.4 m of 32 elements, 2400 kg/m^3, E 30 MPa, with its foot in the ground by as much as its
/// weight presses it in. In a world of that gravity.
const DestructibleBody* add(CaseWorld& world, Precision precision, double substepSafety,
                            const Eigen::Vector3d& velocity);
btRigidBody& addStock(CaseWorld& world);

}  // namespace rubble::demo::block
