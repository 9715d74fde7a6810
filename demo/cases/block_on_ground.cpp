#include "demo/cases/block_on_ground.h"

namespace rubble::demo::block {
namespace {

const Eigen::Vector3d kSize(0.4, 0.1, 0.4);  // flat, so that it does not tip [m]
constexpr std::size_t kElements = 32;
constexpr double kDensity = 2400, kModulus = 30e6;  // [kg/m^3], [Pa]

void addGround(CaseWorld& world) {
  world.add(0, std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), {0, 0, 0})
      .setFriction(1);
}

}  // namespace

const DestructibleBody* add(CaseWorld& world, Precision precision, double substepSafety,
                            const Eigen::Vector3d& velocity) {
  addGround(world);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox(kSize, kElements);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.friction = kFriction;
  const double stiffness = def.material.contactStiffness * kModulus / def.asset->spacing();  // [Pa/m]
  def.transform.setOrigin(toBullet({0, kSize.y() / 2 - kDensity * kGravity * kSize.y() / stiffness, 0}));
  def.velocity = toBullet(velocity);
  return world.destruct(precision, substepSafety).addBody(def);
}

btRigidBody& addStock(CaseWorld& world) {
  addGround(world);
  btRigidBody& block = world.add(kDensity * kSize.prod(), std::make_unique<btBoxShape>(toBullet(kSize / 2)),
                                 {0, kSize.y() / 2, 0});
  block.setFriction(btScalar(kFriction));
  return block;
}

}  // namespace rubble::demo::block
