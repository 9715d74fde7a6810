// Debris against what Bullet and the elements put in their way: pushes, and what they rest on.
#include <gtest/gtest.h>

#include "bullet/bullet_world.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"
#include "support/grid_asset.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
namespace {

using debris::DebrisParcel;
using debris::SurfaceImpulse;

constexpr double kTick = 1.0 / 240;
constexpr double kEdge = 0.0337;  // of one element [m]: 92 g of concrete

// `count` pieces of 6.4 g at 10 m/s, one behind the other, from above and a little beside the middle.
std::vector<DebrisParcel> volley(int count, const Eigen::Vector3d& target) {
  std::vector<DebrisParcel> parcels;
  for (int i = 0; i < count; ++i) {
    const double turn = 2.4 * i;  // the golden angle [rad]: no two alike
    const Eigen::Vector3d beside(0.008 * std::cos(turn), 0.03, 0.008 * std::sin(turn));
    DebrisParcel parcel = stone(target + beside, {1, -10, -2});
    parcel.mass = 0.0064;
    parcels.push_back(parcel);
  }
  return parcels;
}

double residual(const Ledger& l) {
  return l.kinetic + l.elastic + l.debris + l.dissipated + l.fracture + l.removed - l.gravity - l.exchanged;
}

// One step of debris against one free element, without Bullet's tick around it.
struct ElementVolley {
  explicit ElementVolley(int count, Precision precision) : world(of(precision)) {
    world.world.setGravity({0, 0, 0});
    DestructibleBodyDef def;
    def.asset = std::make_shared<const Asset>(
        gridAsset({.cubes = {1, 1, 1}, .edge = kEdge, .origin = {0, 5, 0}, .anchored = false}));
    def.material = material("concrete_soft");
    def.anchored = false;
    id = world.destruction->addBody(def)->id();
    auto& system = *impl().debrisSystem;
    system.add(volley(count, impl().solver->position(id, 0)));
    start = system.motion();
    system.takeExchange();
    system.step(kTick, Eigen::Vector3d::Zero(), *impl().surroundings);
    impulses.assign(system.surfaceImpulses().begin(), system.surfaceImpulses().end());
  }
  static DestructionDef of(Precision precision) {
    DestructionDef def;
    def.precision = precision;
    return def;
  }
  Destruction::Impl& impl() { return world.destruction->impl(); }
  debris::Motion element() {
    const auto& s = *impl().solver;
    return debris::motionOf(s.view(id).mass[0], s.view(id).inertia[0], s.position(id, 0), s.velocity(id, 0),
                            s.spin(id, 0));
  }
  // Balances of the step alone.
  Ledger pushAndBook() {
    const bullet::ElementPush push = impl().surroundings->push(impulses);
    exchange = impl().debrisSystem->takeExchange();
    bullet::LedgerBook book;
    book.addExchange(exchange);
    book.addPush(push);
    book.close(impl().solver->books(), impl().debrisSystem->motion());
    return book.ledger();
  }

  BulletWorld world;
  std::uint32_t id = 0;
  debris::Motion start;
  std::vector<SurfaceImpulse> impulses;
  debris::Exchange exchange;
};

TEST(DebrisPush, PiecesOfOneTickMakeNoEnergyOnAnElement) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    // Velocities of some 10 m/s in the elements' scalar; a push is rounded once.
    const double rounding = precision == Precision::Float ? 1e-6 : 1e-13;
    for (const int count : {1, 20, 60}) {
      ElementVolley volley(count, precision);
      const Ledger ledger = volley.pushAndBook();
      const debris::Motion pieces = volley.impl().debrisSystem->motion(), element = volley.element();
      EXPECT_LE(pieces.kinetic + element.kinetic, volley.start.kinetic) << count;
      EXPECT_LT(element.linear.y(), -0.05) << "they did hit";
      const Eigen::Vector3d linear = pieces.linear + element.linear - volley.exchange.air.linear;
      const Eigen::Vector3d angular = pieces.angular + element.angular - volley.exchange.air.angular;
      EXPECT_LT((linear - volley.start.linear).norm(), rounding) << count;
      EXPECT_LT((angular - volley.start.angular).norm(), 5 * rounding) << count << "; 5 m from the origin";
      // No Bullet body is there; what the pieces lost the element has, but for what the hits dissipated. The
      // pieces came from nowhere, so their first energy is the whole of the balance.
      EXPECT_NEAR(ledger.exchanged, 0, 1e-12);
      EXPECT_GT(ledger.dissipated, 0);
      EXPECT_NEAR(residual(ledger), volley.start.kinetic, 10 * rounding) << count;
    }
  }
}

TEST(DebrisPush, LedgerShowsEnergyThatTheHitsDidNotGive) {
  // Every hit twice as strong as it was booked: the element has four times the energy it was given.
  ElementVolley volley(20, Precision::Double);
  double given = 0;
  for (SurfaceImpulse& impulse : volley.impulses) {
    impulse.linear *= 2;
    impulse.angular *= 2;
    given += impulse.work;
  }
  const Ledger ledger = volley.pushAndBook();
  EXPECT_GT(given, 0.1);
  EXPECT_NEAR(residual(ledger), volley.start.kinetic + 3 * given, 1e-9);
  EXPECT_GT(ledger.linearError, 0.1);
}

TEST(DebrisPush, PiecesOfOneTickMakeNoEnergyOnALightBody) {
  for (const int count : {1, 20, 60}) {
    BulletWorld w;
    w.world.setGravity({0, 0, 0});
    btBoxShape boxShape({btScalar(0.02), btScalar(0.02), btScalar(0.02)});
    btRigidBody* box = w.add(btScalar(0.09), boxShape, {0, 5, 0});
    box->setLinearFactor({1, 1, 0});  // held in a plane
    Destruction::Impl& impl = w.destruction->impl();
    impl.debrisSystem->add(volley(count, {0, 5, 0}));
    const debris::Motion start = impl.debrisSystem->motion();
    impl.debrisSystem->takeExchange();
    impl.debrisSystem->step(kTick, Eigen::Vector3d::Zero(), *impl.surroundings);
    impl.surroundings->push(impl.debrisSystem->surfaceImpulses());
    const debris::Motion pieces = impl.debrisSystem->motion();
    const debris::Exchange exchange = impl.debrisSystem->takeExchange();
    const Eigen::Vector3d v = bullet::toEigen(box->getLinearVelocity());
    const Eigen::Vector3d w1 = bullet::toEigen(box->getAngularVelocity());
    const double kinetic =
        0.5 * (0.09 * v.squaredNorm() + w1.squaredNorm() / double(box->getInvInertiaDiagLocal().x()));
    EXPECT_LE(pieces.kinetic + kinetic, start.kinetic) << count;
    EXPECT_LT(v.y(), -0.3) << "they did hit";
    EXPECT_EQ(v.z(), 0);
    EXPECT_NEAR(exchange.workOnSurfaces, kinetic, 1e-5 * kinetic) << "in Bullet's float";
    const Eigen::Vector3d lost = start.linear + exchange.air.linear - pieces.linear;
    EXPECT_NEAR(0.09 * v.x(), lost.x(), 1e-6);
    EXPECT_NEAR(0.09 * v.y(), lost.y(), 1e-6);
  }
}

}  // namespace
}  // namespace rubble::test
