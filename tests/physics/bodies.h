// Bodies and solvers for the tests of the element mechanics.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "edem/one_body.h"
#include "edem/solver.h"
#include "support/grid_asset.h"

namespace rubble::test {

inline const Eigen::Vector3d kGravity(0, -9.81, 0);
inline const Eigen::Vector3d kNoGravity = Eigen::Vector3d::Zero();
inline constexpr double kFrame = 1.0 / 60;

/// A block of cubes of 0.2 m; without any damping, friction or loss of blows unless the test sets some.
inline edem::BodyDef block(const std::array<int, 3>& cubes, bool anchored = false, double edge = 0.2) {
  GridAssetDef grid;
  grid.cubes = cubes;
  grid.edge = edge;
  grid.anchored = anchored;
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(gridAsset(grid));
  def.anchored = anchored;
  def.material.springDamping = 0;
  def.material.contactDamping = 0;
  def.material.friction = 0;
  def.material.restitution = 1;
  return def;
}

template <class Real>
std::unique_ptr<edem::Solver> makeSolver(bool breaking = true,
                                         double substepSafety = edem::SolverDef{}.substepSafety) {
  edem::SolverDef def;
  def.breaking = breaking;
  def.crushing = breaking;
  def.substepSafety = substepSafety;
  return edem::Solver::make(std::is_same_v<Real, float> ? Precision::Float : Precision::Double, def);
}

/// A ball without spin; mass in kilograms, radius in metres.
inline edem::RigidProxy ball(double radius, double mass, const Eigen::Vector3d& at,
                             const Eigen::Vector3d& velocity) {
  edem::RigidProxy proxy;
  proxy.position = at;
  proxy.velocity = velocity;
  proxy.inverseMass = 1 / mass;
  proxy.inverseInertia.setConstant(1 / (0.4 * mass * radius * radius));
  edem::Collider sphere;
  sphere.size.setConstant(radius);
  proxy.parts = {sphere};
  return proxy;
}

/// A body that does not move, of one surface.
inline edem::RigidProxy fixed(const edem::Collider& part,
                              const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  edem::RigidProxy proxy;
  proxy.position = at;
  proxy.parts = {part};
  return proxy;
}

/// A plane through the origin that falls towards x by `tilt` [rad].
inline edem::RigidProxy fixedPlane(double tilt = 0) {
  edem::Collider part;
  part.kind = edem::Collider::Kind::Plane;
  part.size = {std::sin(tilt), std::cos(tilt), 0};
  return fixed(part);
}

inline edem::RigidProxy fixedBox(const Eigen::Vector3d& half, const Eigen::Vector3d& at) {
  edem::Collider part;
  part.kind = edem::Collider::Kind::Box;
  part.size = half;
  return fixed(part, at);
}

using edem::OneBody;

/// Numbers in [-1, 1], the same on every machine.
class Numbers {
 public:
  double next() { return double(m_engine()) / double(std::mt19937::max()) * 2 - 1; }
  Eigen::Vector3d vector(double size) {
    const double x = next(), y = next(), z = next();
    return size * Eigen::Vector3d(x, y, z);
  }

 private:
  std::mt19937 m_engine{7};
};

using Scalars = ::testing::Types<float, double>;

}  // namespace rubble::test
