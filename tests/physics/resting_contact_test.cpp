// Contacts of loose and of light things: they gain no energy, come to rest, and do not let anything through.
#include "physics/bodies.h"

namespace rubble::test {
namespace {

constexpr double kCube = 0.2;  // edge of a cube, twice the radius of its element [m]
constexpr double kCubeMass = 2400 * kCube * kCube * kCube;

constexpr double kDegree = 3.14159265358979323846 / 180;

// As rough as the elements are.
edem::RigidProxy groundPlane(double degrees = 0) {
  edem::RigidProxy proxy = fixedPlane(degrees * kDegree);
  proxy.friction = 1;
  return proxy;
}

// A slab that lies on groundPlane(degrees) and loses what shakes it.
edem::BodyDef slabOnSlope(double degrees, double friction) {
  edem::BodyDef def = block({2, 1, 2});
  def.transform = Eigen::AngleAxisd(-degrees * kDegree, Eigen::Vector3d::UnitZ());
  def.material.friction = friction;
  def.material.contactDamping = 0.3;
  def.material.springDamping = 0.1;
  return def;
}

template <class Real>
class RestingContact : public ::testing::Test {
 protected:
  void run(double seconds, double dt, std::vector<edem::RigidProxy>& proxies) {
    for (int t = 0; t < int(seconds / dt + 0.5); ++t) {
      solver->tick(dt, kGravity, proxies);
      ASSERT_EQ(solver->failure(), "");
      fastest = std::max(fastest, solver->maxSpeed(0));
    }
  }
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>(false);
  double fastest = 0;
};
TYPED_TEST_SUITE(RestingContact, Scalars);

TYPED_TEST(RestingContact, LooseElementIsNoFasterThanItFell) {
  for (const double rate : {60.0, 240.0}) {
    for (const double damping : {0.0, 0.3, 1.0}) {
      this->solver = makeSolver<TypeParam>(false);
      this->fastest = 0;
      edem::BodyDef def = block({1, 1, 1});
      def.transform.translation() = Eigen::Vector3d(0, 0.3, 0);
      def.material.contactDamping = damping;
      this->solver->addBody(def, kNoGravity);
      std::vector<edem::RigidProxy> proxies = {groundPlane()};
      this->run(2, 1 / rate, proxies);
      // Symplectic Euler falls by half a step's speed further.
      EXPECT_LT(this->fastest, std::sqrt(2 * 9.81 * 0.3) + 9.81 / rate) << rate << " Hz, " << damping;
    }
  }
}

TYPED_TEST(RestingContact, LooseElementsInAHeapGainNothing) {
  // A block without strength, its elements 1 mm apart from touching: its springs are broken by hand.
  edem::BodyDef def = block({3, 3, 3});
  def.transform.translation() = Eigen::Vector3d(0, 0.3, 0);
  def.material.tensileStrength = def.material.compressiveStrength = 0;
  def.material.contactDamping = 0.3;
  def.material.friction = 0.6;
  this->solver = makeSolver<TypeParam>(true);
  this->solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {groundPlane()};
  this->run(0.4, kFrame, proxies);
  EXPECT_LT(this->fastest, std::sqrt(2 * 9.81 * 0.9));  // from the top of the block to the ground
}

TYPED_TEST(RestingContact, BlockDoesNotCreepDownASlopeItCanStandOn) {
  for (const double degrees : {12.0, 25.0}) {
    this->solver = makeSolver<TypeParam>(false);
    this->solver->addBody(slabOnSlope(degrees, 0.6), kNoGravity);  // holds to 31 degrees
    std::vector<edem::RigidProxy> proxies = {groundPlane(degrees)};
    this->run(1, kFrame, proxies);
    const Eigen::Vector3d before = this->solver->position(0, 0);
    this->run(4, kFrame, proxies);
    EXPECT_LT((this->solver->position(0, 0) - before).norm(), 1e-5) << degrees;
  }
}

TYPED_TEST(RestingContact, BlockSlidesWhereFrictionDoesNotHold) {
  constexpr double kDegrees = 28;
  this->solver->addBody(slabOnSlope(kDegrees, 0.3), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {groundPlane(kDegrees)};
  const Eigen::Vector3d before = this->solver->position(0, 0);
  this->run(1, kFrame, proxies);
  const double way = 0.5 * 9.81 * (std::sin(kDegrees * kDegree) - 0.3 * std::cos(kDegrees * kDegree));
  EXPECT_NEAR((this->solver->position(0, 0) - before).norm(), way, 0.03 * way);
}

TYPED_TEST(RestingContact, RollingElementStops) {
  edem::BodyDef def = block({1, 1, 1});
  def.velocity = Eigen::Vector3d(1, 0, 0);
  def.material.contactDamping = 0.3;
  def.material.friction = 0.6;
  def.material.rollingFriction = 0.1;
  def.model.cellFaces = false;
  this->solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {groundPlane()};
  this->run(4, kFrame, proxies);
  EXPECT_LT(this->solver->maxSpeed(0), 1e-3);
  // It slides until friction, less the resistance to rolling, has spun it up, then rolls to its end. I / m
  // r^2 is 4 / 6, a cube's; v' = -mu g, r w' = (mu - mu_r) g / (4/6), then (1 + 4/6) v' = -mu_r g.
  const double inertia = 4.0 / 6, g = 9.81;
  const double spinUp = 1 / (g * (0.6 + 0.5 / inertia));  // [s]
  const double rolling = 1 - 0.6 * g * spinUp;            // speed then [m/s]
  const double way = 0.5 * (1 + rolling) * spinUp + rolling * rolling * (1 + inertia) / (2 * 0.1 * g);
  EXPECT_NEAR(this->solver->position(0, 0).x() - 0.1, way, 0.01 * way);
}

TYPED_TEST(RestingContact, OneElementStaysOnASlope) {
  // The grid's box of a single element is a point. As a sphere it rolls down; as a cube it stands, for the
  // tangents of both slopes are below the friction of 0.6.
  for (const bool faces : {false, true}) {
    for (const bool onBox : {false, true}) {
      for (const double degrees : {10.0, 25.0}) {
        this->solver = makeSolver<TypeParam>(false);
        edem::BodyDef def = block({1, 1, 1});
        def.transform.translation() = Eigen::Vector3d(0, 0.15, 0);
        def.material.friction = 0.6;
        def.material.rollingFriction = 0;
        def.material.contactDamping = 0.3;
        def.model.cellFaces = faces;
        this->solver->addBody(def, kNoGravity);
        std::vector<edem::RigidProxy> proxies = {groundPlane(degrees)};
        const Eigen::Vector3d normal = proxies[0].parts[0].size;
        if (onBox) {
          proxies = {fixedBox({20, 0.5, 20}, -0.5 * normal)};
          proxies[0].orientation = Eigen::AngleAxisd(-degrees * kDegree, Eigen::Vector3d::UnitZ());
          proxies[0].friction = 1;
        }
        for (int t = 0; t < 120; ++t) {
          this->run(kFrame, kFrame, proxies);
          ASSERT_GT(this->solver->position(0, 0).dot(normal), 0.095);
        }
        if (faces)
          EXPECT_LT(this->solver->maxSpeed(0), 1e-3) << degrees << (onBox ? " on a box" : " on a plane");
        else
          EXPECT_GT(this->solver->position(0, 0).x(), 0.2)
              << degrees << (onBox ? " on a box" : " on a plane");
      }
    }
  }
}

TYPED_TEST(RestingContact, LightPlateOnManyElementsGainsNothing) {
#ifdef RUBBLE_SANITIZED  // the same code at every mass and on every element: 400 elements take a second a
                         // tick
  const std::vector<double> masses = {0.1};
  constexpr std::uint32_t kSide = 8;
#else
  const std::vector<double> masses = {0.1, 0.5, 1.0, 5.0};
  constexpr std::uint32_t kSide = 20;
#endif
  constexpr double kEdge = 0.0337;
  constexpr double kHalf = kSide * kEdge / 2, kPlate = kHalf - 0.002;  // [m]
  edem::BodyDef def = block({kSide, 1, kSide}, true, kEdge);
  def.material.contactDamping = 0.3;
  for (const double mass : masses) {
    this->solver = makeSolver<TypeParam>(false);
    this->solver->addBody(def, kNoGravity);
    edem::RigidProxy proxy = fixedBox({kPlate, 0.01, kPlate}, {kHalf, kEdge + 0.012, kHalf});
    proxy.inverseMass = 1 / mass;
    proxy.inverseInertia = Eigen::Vector3d(12, 6, 12) / (mass * 4 * kPlate * kPlate);
    std::vector<edem::RigidProxy> proxies = {proxy};
    this->fastest = 0;
    for (int t = 0; t < 20; ++t) {
      proxies[0].acceleration = kGravity;
      this->solver->tick(kFrame, kGravity, proxies);
      this->fastest = std::max(this->fastest, proxies[0].velocity.norm());
      EXPECT_GT(proxies[0].position.y(), kEdge + 0.009) << mass;
    }
    EXPECT_LT(this->fastest, std::sqrt(2 * 9.81 * 0.002) + 9.81 * kFrame) << mass;
    EXPECT_LT(proxies[0].velocity.norm(), 0.01) << mass;
  }
}

TYPED_TEST(RestingContact, SoftOnStiffGainsNothing) {
  for (const double modulus : {1e4, 1e5}) {
    for (const double edge : {0.02, 0.1}) {
      this->solver = makeSolver<TypeParam>(false);
      edem::BodyDef stone = block({3, 1, 3}, true), foam = block({2, 2, 2}, false, edge);
      foam.material.density = 30;
      foam.material.youngsModulus = modulus;
      foam.transform.translation() = Eigen::Vector3d(0.3 - edge, kCube + 0.001, 0.3 - edge);
      foam.velocity = Eigen::Vector3d(0, -1, 0);
      this->solver->addBody(stone, kNoGravity);
      const std::uint32_t id = this->solver->addBody(foam, kNoGravity);
      for (int t = 0; t < 60; ++t) this->solver->tick(kFrame, kNoGravity, {});
      const edem::Books& books = this->solver->books();
      EXPECT_EQ(this->solver->failure(), "");
      EXPECT_LT(books.kinetic + books.elastic, 1.01 * books.initialEnergy) << modulus << ", " << edge;
      EXPECT_GT(this->solver->velocity(id, 0).y(), 0) << "it has bounced";
    }
  }
}

TYPED_TEST(RestingContact, KinematicBodyPressesWhatAnAnchorCarries) {
  for (const bool kinematic : {false, true}) {
    this->solver = makeSolver<TypeParam>(false);
    this->solver->addBody(block({3, 1, 3}, true), kNoGravity);
    std::vector<edem::RigidProxy> proxies = {fixedBox({0.1, 0.1, 0.1}, {0.3, kCube + 0.101, 0.3})};
    proxies[0].kinematic = kinematic;
    proxies[0].velocity = Eigen::Vector3d(0, -0.1, 0);
    for (int t = 0; t < 6; ++t) this->solver->tick(kFrame, kNoGravity, proxies);
    // A static one is what the anchor ties the element to.
    EXPECT_EQ(proxies[0].contactWeight > 0, kinematic);
  }
}

TYPED_TEST(RestingContact, FirstSeenDeepGivesNoKick) {
  // Half a radius deep in one box, and as near to another that it must not be mistaken for.
  this->solver->addBody(block({1, 1, 1}), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {fixedBox({1, 1, 1}, {0.1, -0.95, 0.1}),
                                           fixedBox({1, 1, 1}, {1.23, 0.1, 0.1})};
  for (int t = 0; t < 30; ++t) {
    this->solver->tick(kFrame, kNoGravity, proxies);
    EXPECT_LT(this->solver->maxSpeed(0), 0.01);
  }
}

// Balance of a block that meets a plane, over its first energy.
template <class Real>
double balanceAtAPlane(double restitution, double substepSafety) {
  edem::SolverDef solverDef;
  solverDef.substepSafety = substepSafety;
  solverDef.breaking = solverDef.crushing = false;
  const auto solver =
      edem::Solver::make(std::is_same_v<Real, float> ? Precision::Float : Precision::Double, solverDef);
  edem::BodyDef def = block({2, 2, 2});
  def.velocity = Eigen::Vector3d(1, -3, 0);
  def.transform.translation() = Eigen::Vector3d(0, 0.05, 0);
  def.material.friction = 0.6;
  def.material.restitution = restitution;
  solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {groundPlane()};
  proxies[0].restitution = 1;
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kNoGravity, proxies);
  const edem::Books& b = solver->books();
  EXPECT_EQ(b.bullet.work.done(), 0);
  EXPECT_GT(b.bullet.linear.norm(), 100) << "it has met the plane";
  return (b.kinetic + b.elastic - b.dissipated.done()) / b.initialEnergy - 1;
}

TYPED_TEST(RestingContact, StaticBodyGivesNoEnergy) {
  // So the balance is of the elements and their contacts alone, and can fail.
  EXPECT_NEAR(balanceAtAPlane<TypeParam>(1, 0.9), 0, 1e-3);
  // What is withheld begins at an instant and not where the block turns round: an error that falls with the
  // substep.
  const double whole = balanceAtAPlane<TypeParam>(0, 0.9), half = balanceAtAPlane<TypeParam>(0, 0.45),
               quarter = balanceAtAPlane<TypeParam>(0, 0.225);
  EXPECT_LT(std::abs(half), 1e-3);
  EXPECT_LT(std::abs(quarter), 0.25 * std::abs(whole));
}

TYPED_TEST(RestingContact, WhatAContactRemembersSurvivesSleep) {
  constexpr double kDegrees = 17;
  this->solver->addBody(slabOnSlope(kDegrees, 0.6), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {groundPlane(kDegrees)};
  this->run(2, kFrame, proxies);
  const Eigen::Vector3d before = this->solver->position(0, 0);
  for (int nap = 0; nap < 20; ++nap) {
    this->solver->setAsleep(0, true);
    this->run(kFrame, kFrame, proxies);
    this->solver->setAsleep(0, false);
    this->run(kFrame, kFrame, proxies);
  }
  // Without its memory it would sag by the springs' length each time: m g sin / (n k_t), four elements a
  // side.
  const double sag = kCubeMass * 9.81 * std::sin(kDegrees * kDegree) / (0.2 * 0.5 * 30e6 * kCube);
  EXPECT_LT((this->solver->position(0, 0) - before).norm(), sag);
}

}  // namespace
}  // namespace rubble::test
