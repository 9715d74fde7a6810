// What debris need to know about their surroundings. The Bullet layer answers from its world and the intact
// bodies; tests answer from planes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace rubble::debris {

/// Surface id of what never moves and never leaves; what it receives is booked in the ledger only.
inline constexpr std::uint32_t kFixedSurface = 0xffffffffu;

/// First touch of a moving ball.
struct DebrisHit {
  double fraction = 0;                               ///< of the way done until the touch, 0 to 1
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from the surface towards the ball
  std::uint32_t surface = kFixedSurface;             ///< kFixedSurface, or less than surfaceCount()
};

/// The body behind a surface at the start of a step. All 0: it stands, whatever hits it.
struct DebrisSurface {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();       ///< of mass [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();     ///< of `centre` [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();         ///< [rad/s]
  Eigen::Vector3d inverseMass = Eigen::Vector3d::Zero();  ///< along each of the world's axes [1/kg], >= 0
  /// About `centre` in the world's axes [1/(kg m^2)]; symmetric, no eigenvalue below 0.
  Eigen::Matrix3d inverseInertia = Eigen::Matrix3d::Zero();

  /// True when no impulse changes its motion.
  bool isHeld() const { return inverseMass.isZero(0) && inverseInertia.isZero(0); }
  Eigen::Vector3d velocityAt(const Eigen::Vector3d& at) const { return velocity + spin.cross(at - centre); }
};

/// Called from one thread at a time, only inside DebrisSystem::step.
class DebrisCollider {
 public:
  virtual ~DebrisCollider() = default;

  /// Once at the start of a step: all sweeps of the step that end without a hit stay inside `swept` [m].
  virtual void begin(const Eigen::AlignedBox3d& swept) { static_cast<void>(swept); }

  /// Surfaces have ids below this, which never falls. An id means the same surface in every step in which
  /// pieces rest on it; whoever takes a surface away calls DebrisSystem::wakeSupports with its id.
  virtual std::uint32_t surfaceCount() const { return 0; }

  /// The body behind a surface that was hit in this step; asked once a step, at the first hit. What the hits
  /// of the step do to its motion is DebrisSystem's to follow, its place stays as it is.
  virtual DebrisSurface surface(std::uint32_t id) const { return static_cast<void>(id), DebrisSurface{}; }

  /// A piece came to rest on this surface, and is not looked at again until it is woken.
  virtual void noteSupport(std::uint32_t id) { static_cast<void>(id); }

  /// Moves a ball of `radius` (0: a point) from `from` to `to` past the surroundings as they stand now. True
  /// when it touches: `hit` is the first touch. A surface that the ball overlaps at the start counts as
  /// touched at fraction 0, unless (to - from) . normal > 0: a ball that leaves is not held.
  virtual bool sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                     DebrisHit& hit) = 0;

  /// The same for surfaces alone that have no inside, as a terrain: what comes beyond them is not put back.
  virtual bool sweepThin(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                         DebrisHit& hit) {
    static_cast<void>(from), static_cast<void>(to), static_cast<void>(radius), static_cast<void>(hit);
    return false;
  }
};

}  // namespace rubble::debris
