// What stands behind a DestructibleBody.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bullet/anchor_body.h"
#include "bullet/coupler_constraint.h"
#include "bullet/element_shape.h"
#include "bullet/host_settings.h"
#include "bullet/load_gauge.h"
#include "bullet/shown.h"
#include "bullet/whole_shape.h"
#include "debris/spawn.h"
#include "rubble/destructible_body.h"

namespace rubble {
RUBBLE_ABI_BEGIN

struct DestructibleBody::Impl {
  enum class State {
    Elements,
    Whole,    // Bullet's
    Thawing,  // the elements', from within a tick of Bullet's; Bullet's part follows at its end
  };
  static void* operator new(std::size_t size);
  static void operator delete(void* memory, std::size_t size);

  // What each tick looks at of a whole body stands first, in one line of the cache.
  State state = State::Elements;
  std::uint32_t id = 0;
  Destruction::Impl* world = nullptr;  ///< null once the Destruction is gone
  double strikingSpeed = 0;            ///< what nears it faster strikes it [m/s]; of one that may be whole
  btScalar reach = 0;                  ///< of its shape about Bullet's centre [m]
  int idleTicks = 0;                   ///< for which its coupler was in Bullet's world for nothing
  bool coupled = false;                ///< its coupler is in Bullet's world
  bool met = false;                    ///< while whole: in this tick, by what may strike it
  bool struck = false;                 ///< while whole: by the application, or overloaded
  bool held = false;                   ///< by anchors
  int gyroscopicFlags = 0;             ///< Bullet's, taken from it while it turns too fast for its ticks
  bool isLooked = false;               ///< this tick's end looks at its load
  bool isGauged = false;               ///< in this tick
  std::unique_ptr<bullet::LoadGauge> gauge;   ///< of a body that may be whole
  bullet::WholeShape whole;                   ///< without a shape while the body is not to be whole
  int flags = 0;                              ///< Bullet's of collision, from before the thaw
  bullet::AnchorBody anchorBody;              ///< while anchors hold to one
  bullet::HostSettings settings;              ///< from before the thaw
  double restTime = 0;                        ///< since it was last too restless to be whole [s]
  bullet::Pressure pressure;                  ///< of its contacts while whole, of this tick
  std::vector<bullet::ContactPatch> patches;  ///< on it while whole, of this tick
  double thawLoad = 0;                        ///< share of strength for which it thawed; 0: not by a load
  double survivedLoad = 0;                    ///< the largest of these from which it came back whole
  double easeTime = 0;                        ///< for which it is still eased into a load [s]
  std::uint32_t source = 0;                   ///< id of the body that was added and of which it is a part
  std::shared_ptr<const Asset> asset;
  rubble::Material material;
  Model model;
  std::unique_ptr<bullet::ElementShape> shape;
  std::unique_ptr<bullet::CouplerConstraint> coupler;
  std::unique_ptr<debris::Spawner> spawner;
  std::vector<double> bondConstants;                     ///< C_B of each element [J m^0.5]
  std::vector<std::uint8_t> wasRoot;                     ///< elements that were the lowest of a fragment
  std::string name;                                      ///< for messages: "body 3 (concrete, 2 m tall)"
  std::string advice;                                    ///< why it will not last; empty if nothing is known
  btVector3 shownVelocity{0, 0, 0}, shownSpin{0, 0, 0};  ///< to the application, while it is elements
  btTransform shownPlace = btTransform::getIdentity();   ///< the same
  bullet::Shown shown;                                   ///< what of it that is
  bool lay = false;                                      ///< nothing of it moved when the last tick ended
  bool jointed = false;                                  ///< joints of the application hold it
  bool inSolver = false;                                 ///< Bullet has solved its island in this tick
  /// What its joints' loads have given it in this tick, as one [m/s], [rad/s].
  Eigen::Vector3d jointVelocity = Eigen::Vector3d::Zero(), jointSpin = Eigen::Vector3d::Zero();
  /// Of its joints' impulses about its centre when the tick began [N m s].
  Eigen::Vector3d jointAngular = Eigen::Vector3d::Zero();
  bool fixed = false;                                   ///< to Bullet's joints: anchors hold what they do
  btVector3 freeLinear{1, 1, 1}, freeAngular{1, 1, 1};  ///< its factors when it is not
  double speed = 0;                      ///< of its fastest element when the last tick ended [m/s]
  std::vector<btCollisionObject*> near;  ///< noted by the narrowphase of this tick
};

/// What stands behind the two public classes, for our own files and tests alone.
struct ImplAccess {
  template <class T>
  static auto& of(T& object) {
    return *object.m_impl;
  }
};
inline DestructibleBody::Impl& implOf(DestructibleBody& body) {
  return ImplAccess::of(body);
}
inline const DestructibleBody::Impl& implOf(const DestructibleBody& body) {
  return ImplAccess::of(body);
}
inline Destruction::Impl& implOf(Destruction& destruction) {
  return ImplAccess::of(destruction);
}

/// Downcast of a body that its elements move; null for whole ones and other objects.
inline const DestructibleBody* upcastElements(const btCollisionObject* object) {
  const DestructibleBody* body = DestructibleBody::upcast(object);
  return body && !body->isWhole() ? body : nullptr;
}
inline DestructibleBody* upcastElements(btCollisionObject* object) {
  return const_cast<DestructibleBody*>(upcastElements(static_cast<const btCollisionObject*>(object)));
}

RUBBLE_ABI_END
}  // namespace rubble
