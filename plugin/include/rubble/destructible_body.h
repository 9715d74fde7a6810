// One destructible object in a Bullet world.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cstddef>
#include <memory>
#include <span>

#include "rubble/destruction.h"

namespace rubble {
RUBBLE_ABI_BEGIN

/// While its elements move it, Bullet sees a body of true mass that it never moves itself: shape, place and
/// motion are the elements', all of them together. In one piece its Bullet frame is that of the body as a
/// whole, or has its origin in the centre of mass and the asset's axes; in several it has its origin in the
/// centre of mass of all and turns with the heaviest. Velocities, impulses, forces and its own gravity that
/// the application sets act on all of them as one in the next tick; a transform puts all of them there,
/// anchors too. Joints hold it: once in several pieces Bullet sees the heaviest that a joint holds in place
/// of all. While it is whole, as the default is until it is struck, it is a rigid body as any other. Either
/// way poses() tells where the elements are. Made by Destruction::addBody only.
class DestructibleBody final : public btRigidBody {
 public:
  ~DestructibleBody() override;

  /// Downcast as Bullet's own upcast functions do; null for other objects.
  static DestructibleBody* upcast(btCollisionObject* object);
  static const DestructibleBody* upcast(const btCollisionObject* object);

  std::uint32_t id() const;  ///< index in Destruction::bodies() order of adding; never reused
  /// Id of the body that was added and of which this is a fragment (DestructionDef::fragmentBodyElements);
  /// its own where it was added itself. Elements and springs have the numbers that they had there; those that
  /// another body has are not alive and not intact here.
  std::uint32_t source() const;
  const std::shared_ptr<const Asset>& asset() const;
  const Material& material() const;
  const Model& model() const;
  /// Poses of all elements (n), for drawing.
  void poses(std::span<ElementPose> out) const;
  /// The living element whose cell has a place in the world, or is nearest to it: what a ray, a sweep or a
  /// contact has hit of a whole body, of which Bullet's callbacks tell no index. Looks at all elements.
  /// kNoElement: none is alive.
  std::uint32_t elementAt(const btVector3& place) const;
  /// 1 for unbroken (springs, then anchors).
  std::span<const std::uint8_t> springsIntact() const;
  std::span<const std::uint8_t> elementsAlive() const;
  /// Connected component of each element: the lowest element of its fragment; kNoElement for crushed ones.
  std::span<const std::uint32_t> fragments() const;
  /// Sum over the living elements: mass [kg], momentum.
  double elementMass() const;
  btVector3 linearMomentum() const;
  /// Angular momentum about their centre of mass, of a whole body about Bullet's [kg m^2/s].
  btVector3 angularMomentum() const;
  bool isAsleep() const;
  /// Bullet moves it as one rigid body.
  bool isWhole() const;

  struct Impl;

  /// From chunks of their own: what Bullet reads of them in each tick lies side by side.
  static void* operator new(std::size_t size);
  static void operator delete(void* memory, std::size_t size);

 private:
  friend class Destruction;
  friend struct ImplAccess;
  DestructibleBody(const btRigidBodyConstructionInfo& info, std::unique_ptr<Impl> impl);
  /// Bullet asks it before it looks for points of contact.
  bool checkCollideWithOverride(const btCollisionObject* other) const override;
  std::unique_ptr<Impl> m_impl;
};

RUBBLE_ABI_END
}  // namespace rubble
