// Bodies that are Bullet's until they are struck, and how they move, for tests.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "bullet/bullet_world.h"
#include "rubble/destructible_body.h"
#include "support/grid_asset.h"

namespace rubble::test {

inline DestructibleBodyDef wallDef(Regime regime) {
  DestructibleBodyDef def;
  def.asset = smallWall();
  def.material = material("concrete_soft");
  def.regime = regime;
  return def;
}

/// Cubes of 0.05 m, its lowest corner at `corner`.
inline DestructibleBodyDef blockDef(const Eigen::Vector3i& cubes, const btVector3& corner,
                                    Regime regime = Regime::RigidUntilStruck) {
  DestructibleBodyDef def;
  def.asset = std::make_shared<const Asset>(
      gridAsset({.cubes = {cubes.x(), cubes.y(), cubes.z()}, .edge = 0.05, .anchored = false}));
  def.material = material("concrete_soft");
  def.anchored = false;
  def.regime = regime;
  def.transform.setOrigin(corner);
  return def;
}

/// Elements that a body has, now.
inline std::vector<ElementPose> posesOf(const DestructibleBody& body) {
  std::vector<ElementPose> poses(body.asset()->elementCount());
  body.poses(poses);
  return poses;
}

/// Largest way of an element between two poses of a body [m].
inline double largestJump(const std::vector<ElementPose>& from, const std::vector<ElementPose>& to) {
  double most = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    most = std::max(most, double((to[i].position - from[i].position).norm()));
  return most;
}

/// Momentum, and angular momentum about the origin, of a free body of elements or of Bullet's.
struct Momenta {
  btVector3 linear, angular;
  explicit Momenta(const DestructibleBody& body) : linear(body.linearMomentum()) {
    btVector3 centre = body.getWorldTransform().getOrigin();
    if (!body.isWhole()) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const std::vector<ElementPose> poses = posesOf(body);
      for (std::size_t i = 0; i < poses.size(); ++i)
        sum += body.asset()->volumes[i] / body.asset()->volume() * poses[i].position.cast<double>();
      centre = {btScalar(sum.x()), btScalar(sum.y()), btScalar(sum.z())};
    }
    angular = body.angularMomentum() + centre.cross(linear);
  }
};

/// Ticks until `body` is Bullet's or its elements', as wanted; at most `most`.
inline int ticksUntil(BulletWorld& w, const DestructibleBody& body, bool whole, btScalar rate, int most) {
  int ticks = 0;
  for (; ticks < most && body.isWhole() != whole; ++ticks) w.world.stepSimulation(1 / rate, 1, 1 / rate);
  return ticks;
}

}  // namespace rubble::test
