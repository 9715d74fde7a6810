// A rigid body of the host world as the substeps see it: a copy that moves through them and collects what the
// elements do to it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "edem/collider.h"

namespace rubble::edem {

/// A point where a contact of the host's keeps a rigid body from something that is none of the elements.
struct Support {
  static constexpr std::uint32_t kImmovable = 0xffffffffu;
  std::uint32_t other = kImmovable;  ///< place of the other in the list of proxies
  /// From the centre of mass of each, world axes, as the tick began [m].
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), atOther = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  ///< unit, towards the body that has it
  double gap = 0;                                     ///< less than 0: they are in each other [m]
  double friction = 0;
  double pushed = 0;  ///< in this substep [N s]
};

struct RigidProxy {
  // Given by the host before a tick.
  /// Names the body from tick to tick, for what its contacts remember. Not 0; never used again for another.
  std::uint64_t key = 0;
  bool kinematic = false;  ///< moved by the application: presses what an anchor carries, too
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the centre of mass [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();          ///< [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< gravity and the application's forces [m/s^2]
  Eigen::Vector3d angularAcceleration = Eigen::Vector3d::Zero();  ///< [rad/s^2]
  double inverseMass = 0;                                    ///< 0: static or moved by the application [1/kg]
  Eigen::Vector3d inverseInertia = Eigen::Vector3d::Zero();  ///< along its own axes [1/(kg m^2)]
  /// Of a link of an articulated body, or a body that is not free to move in every way: what an impulse on it
  /// and one of rotation about its centre change of its velocity and spin, world axes. Then the two above are
  /// its largest share of each.
  std::optional<Eigen::Matrix<double, 6, 6>> mobility;
  /// What the same changes of other links of that body.
  struct Coupling {
    std::uint32_t proxy;  ///< its place in the list
    Eigen::Matrix<double, 6, 6> mobility;
  };
  std::vector<Coupling> coupled;
  double friction = 0.5;   ///< mu of the pair is this times the element's, as Bullet combines them
  double restitution = 0;  ///< that of the pair is this times the element's
  std::vector<Collider> parts;
  std::vector<std::uint32_t> spared;  ///< bodies whose elements it does not touch (ids)

  bool placed = false;  ///< the application has put it elsewhere since the last tick: no way, but a place
  /// What the host's number for its place may be wrong by: as near to where the last tick left it, a light
  /// body is there still [m].
  float rounding = 0;

  std::vector<std::uint32_t> bears;  ///< bodies whose anchors hold to it (ids): it touches only what is free

  std::vector<Support> supports;  ///< of light bodies alone, each contact at one of its two

  // Collected by the substeps.
  Eigen::Vector3d supportImpulse = Eigen::Vector3d::Zero();         ///< of supports on the rigid body [N s]
  Eigen::Vector3d supportAngularImpulse = Eigen::Vector3d::Zero();  ///< about its centre [N m s]
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();                ///< on the rigid body [N s]
  Eigen::Vector3d angularImpulse = Eigen::Vector3d::Zero();         ///< about its centre of mass [N m s]
  Eigen::Vector3d contactPoint = Eigen::Vector3d::Zero();  ///< impulse-weighted sum of contact points [N s m]
  double contactWeight = 0;                                ///< sum of the sizes of the contact impulses [N s]
  std::vector<std::uint32_t> touched;                      ///< bodies that it pressed in this tick (ids)
  bool pulled = false;                                     ///< by anchors that ride on it
  Eigen::Vector3d anchorImpulse = Eigen::Vector3d::Zero();  ///< of `impulse`, theirs [N s]
  /// Work by its own motion in the substeps, on elements and contacts [J].
  double given = 0;
  /// Of it, what its velocity is ahead of the last instant of forces by: at that instant it held so much more
  /// kinetic energy than it does by its velocity [J].
  double givenNext = 0;
  /// Work on the elements, by their own motion, beyond what the body gave; summed over ticks never more than
  /// 0, or the contacts make energy; without anchors, which are springs of the elements' own. Up to the last
  /// instant of forces [J].
  double surplus = 0;

  bool isDynamic() const { return inverseMass > 0; }
  bool isPressed() const { return contactWeight > 0 || pulled; }
  bool isStatic() const { return !isDynamic() && !kinematic; }
  Eigen::AlignedBox3d bounds() const;  ///< of all parts, in the world
  double reach() const;  ///< furthest point of its parts from the centre of mass [m]; planes count 0
};

/// The surface of all parts nearest to a place, world axes; infinitely far where there are none, and maybe
/// where it is further than `reach`.
SurfacePoint nearest(const RigidProxy& proxy, const Eigen::Vector3d& world,
                     double reach = std::numeric_limits<double>::infinity());

}  // namespace rubble::edem
