// What debris need to know about their surroundings. The Bullet layer answers from its world and the intact
// bodies; tests answer from planes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace rubble::debris {

/// Surface id of all that never moves; what it receives is booked in the ledger only.
inline constexpr std::uint32_t kFixedSurface = 0xffffffffu;

/// First touch of a moving ball.
struct DebrisHit {
  double fraction = 0;                                        ///< of the way done until the touch, 0 to 1
  Eigen::Vector3d point = Eigen::Vector3d::Zero();            ///< of the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();           ///< unit, from the surface towards the ball
  Eigen::Vector3d surfaceVelocity = Eigen::Vector3d::Zero();  ///< of the surface at `point` [m/s]
  /// Of the surface's body, felt at `point` along `normal` [1/kg]; 0 if it yields to nothing.
  double inverseMass = 0;
  std::uint32_t surface = kFixedSurface;  ///< kFixedSurface, or less than surfaceCount()
};

/// Called from one thread at a time, only inside DebrisSystem::step.
class DebrisCollider {
 public:
  virtual ~DebrisCollider() = default;

  /// Once at the start of a step: all sweeps of the step that end without a hit stay inside `swept` [m].
  virtual void begin(const Eigen::AlignedBox3d& swept) { static_cast<void>(swept); }

  /// Movable surfaces have ids below this; an id means the same surface from step to step.
  virtual std::uint32_t surfaceCount() const { return 0; }

  /// Moves a ball of `radius` (0: a point) from `from` to `to` past the surroundings as they stand now. True
  /// when it touches: `hit` is the first touch. A surface that the ball overlaps at the start counts as
  /// touched at fraction 0, unless (to - from) . normal > 0: a ball that leaves is not held.
  virtual bool sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                     DebrisHit& hit) = 0;
};

}  // namespace rubble::debris
