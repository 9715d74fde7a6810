// The law of a hit: Newton's restitution and Coulomb's friction between a piece, which is a point with a spin
// of its own, and the body behind a surface. Free functions; none makes energy, whatever the masses.
#pragma once

#include <Eigen/Core>

#include "debris/debris_collider.h"
#include "debris/particle.h"

namespace rubble::debris {

/// Velocity of the piece after a hit at `velocity` where it is now [m/s]. The impulse acts at its centre:
/// along the normal the one that sends it back at `restitution` times its approach, along the surface at most
/// mu times that and never more than stops the sliding.
Eigen::Vector3d velocityAfterHit(const Particle& particle, const Eigen::Vector3d& velocity,
                                 const Eigen::Vector3d& normal, double restitution,
                                 const DebrisSurface& surface);

/// Spin of the piece after a hit [rad/s]: `restitution` of its spin against the surface is left. A point has
/// no arm for friction to turn it by, and a piece that has come to rest must not spin.
Eigen::Vector3d spinAfterHit(const Particle& particle, double restitution, const DebrisSurface& surface);

}  // namespace rubble::debris
