// What the far ends of anchors move with where that is not the world: a body of the host's. They have a frame
// of their own, which is frame 0 when a tick begins. In the tick it goes to where the host wants it at the
// end on a cubic: positions are met at the ticks' ends, and velocities go on from tick to tick. With a
// velocity for each tick the anchored would be struck by a wave of rho c times its change at every tick of a
// lift that only gathers speed.
//
// Where that body is dynamic the anchors ride on its copy (anchor_ride.h), which they push in turn.
#pragma once

#include <cstdint>
#include <optional>

#include "edem/types.h"

namespace rubble::edem {

/// A rigid motion that displacements are from.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};

/// A translation and a rotation, or their rates.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< of the frame's origin [m], [m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< [rad], [rad/s]

  bool isZero() const { return linear.isZero(0) && angular.isZero(0); }
};

/// A dynamic body of the host's, by its copy in the substeps, that far ends go with.
struct AnchorRide {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint64_t key = 0;        ///< of the copy in the coming tick; 0: none
  Frame hold;                   ///< of the far ends, in its own axes from its centre of mass
  std::uint32_t place = kNone;  ///< of the copy among those of this tick
  double mass = 0;              ///< 0: it stands through this tick [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< of its mass, now [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about that, world axes [kg m^2]
  /// By what the far ends were faster in the last tick than they are as this begins; until the first substep.
  Twist lost;

  bool on() const { return place != kNone; }
  bool moves() const { return on() && mass > 0; }
};

struct AnchorBase {
  bool given = false;           ///< the anchors hold to one; else to the world
  Frame at;                     ///< of the far ends, now
  Twist velocity;               ///< of `at`, over the last substep
  Twist mean;                   ///< over the last tick
  std::optional<Frame> target;  ///< at the end of the next tick; none: it stands still

  // The way through the tick.
  Frame begin;
  Twist way;         ///< to its end
  Twist start, end;  ///< rates there
  double length = 0, time = 0;

  AnchorRide ride;  ///< instead of a way

  bool moves() const { return !way.isZero() || !start.isZero(); }
  Eigen::Vector3d velocityAt(const Eigen::Vector3d& world) const {
    return velocity.linear + velocity.angular.cross(world - at.origin);
  }
};

/// The same of the far ends beside frame 0, as springs take it.
template <class Real>
struct FarEnds {
  Vec3<Real> shift = Vec3<Real>::Zero();
  Quat<Real> turn = Quat<Real>::Identity();
  Vec3<Real> velocity = Vec3<Real>::Zero(), spin = Vec3<Real>::Zero();
};

/// Begins a tick of `dt` seconds from frame 0.
void beginWay(AnchorBase& base, const Frame& frame0, double dt);
/// Goes on by a substep [s].
void advance(AnchorBase& base, double step);
/// Ends the tick: what it is at is what the host wanted.
void endWay(AnchorBase& base);

}  // namespace rubble::edem
