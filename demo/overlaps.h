// Things that start inside one another.
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "demo/scene.h"
#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::demo {

/// An object of the scene where it starts.
struct StandingObject {
  std::shared_ptr<const Asset> asset;
  Eigen::Isometry3d pose;  ///< of the asset's frame
};

/// What takes part in a scene at its start, each list in the scene's order.
struct StartingBodies {
  std::vector<StandingObject> objects;
  std::span<btRigidBody*const> impactors, statics;
  btDynamicsWorld& world;  ///< that impactors and statics are in
};

/// Throws InputError when an impactor or another object starts inside of an object, deeper than a quarter of
/// its elements' radius: at the start such an overlap counts as touching, so that one would move through the
/// other. Warns of an object that is deeper in a static body than one radius, which may be a foundation, and
/// of an impactor that is inside of a static body or of another impactor by more than a tenth of its smallest
/// half extent: Bullet pushes it out.
void checkOverlaps(const Scene& scene, const StartingBodies& bodies, const LogFunction& log);

}  // namespace rubble::demo
