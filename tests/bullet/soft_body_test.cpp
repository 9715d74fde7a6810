// Bullet's soft bodies on destructible bodies, beside the same on a box of Bullet's.
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <gtest/gtest.h>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

constexpr btScalar kSoftRate = 120;
enum class Under { OfBullet, Elements, Whole };

struct SoftWorld {
  explicit SoftWorld(double gravity, LogFunction log = strictLog()) {
    const btVector3 weight(0, btScalar(-gravity), 0);
    world.setGravity(weight);
    world.getWorldInfo().m_gravity = weight;
    world.getWorldInfo().m_sparsesdf.Initialize();
    world.getWorldInfo().m_sparsesdf.setDefaultVoxelsz(btScalar(0.05));
    world.getWorldInfo().m_sparsesdf.Reset();
    world.getWorldInfo().air_density = 0;
    ground = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane));
    DestructionDef def;
    def.log = std::move(log);
    destruction = std::make_unique<Destruction>(world, def);
  }
  ~SoftWorld() {
    destruction.reset();
    if (soft) {
      world.removeSoftBody(soft);
      delete soft;
    }
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[0]);
  }
  void put(Under under, const Eigen::Vector3i& cubes, const btVector3& corner) {
    if (under == Under::OfBullet) {
      const btVector3 half =
          btScalar(0.025) * btVector3(btScalar(cubes.x()), btScalar(cubes.y()), btScalar(cubes.z()));
      boxShape = std::make_unique<btBoxShape>(half);
      box =
          std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, boxShape.get()));
      box->setWorldTransform(btTransform(btQuaternion::getIdentity(), corner + half));
      world.addRigidBody(box.get());
      return;
    }
    DestructibleBodyDef def =
        blockDef(cubes, corner, under == Under::Whole ? Regime::RigidUntilStruck : Regime::Elements);
    def.material.tensileStrength *= strength;
    body = destruction->addBody(def);
  }
  void addBall(const btVector3& at, btScalar mass) {
    soft =
        btSoftBodyHelpers::CreateEllipsoid(world.getWorldInfo(), at, btVector3(1, 1, 1) * btScalar(0.1), 128);
    soft->m_cfg.kPR = 10;
    soft->m_cfg.kDF = btScalar(0.5);
    soft->m_materials[0]->m_kLST = btScalar(0.5);
    add(mass);
  }
  void addCloth(btScalar height, btScalar mass) {
    const btScalar a = btScalar(0.15);
    soft = btSoftBodyHelpers::CreatePatch(world.getWorldInfo(), {-a, height, -a}, {a, height, -a},
                                          {-a, height, a}, {a, height, a}, 13, 13, 0, true);
    add(mass);
  }
  void add(btScalar mass) {
    soft->setTotalMass(mass);
    soft->getCollisionShape()->setMargin(btScalar(0.01));
    world.addSoftBody(soft);
  }
  btScalar lowest() const {
    btScalar y = BT_LARGE_FLOAT;
    for (int n = 0; n < soft->m_nodes.size(); ++n) y = std::min(y, soft->m_nodes[n].m_x.y());
    return y;
  }
  btScalar mean() const {
    btScalar y = 0;
    for (int n = 0; n < soft->m_nodes.size(); ++n)
      y += soft->m_nodes[n].m_x.y() / btScalar(soft->m_nodes.size());
    return y;
  }
  double momentum() const {
    double sum = 0;
    for (int n = 0; n < soft->m_nodes.size(); ++n)
      sum += double(soft->m_nodes[n].m_v.y()) / double(soft->m_nodes[n].m_im);
    return sum;
  }
  void run(double seconds) {
    for (int tick = 0; tick < int(std::lround(seconds * double(kSoftRate))); ++tick)
      world.stepSimulation(1 / kSoftRate, 1, 1 / kSoftRate);
  }

  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btStaticPlaneShape plane{{0, 1, 0}, 0};
  std::unique_ptr<btRigidBody> ground, box;
  std::unique_ptr<btBoxShape> boxShape;
  std::unique_ptr<Destruction> destruction;
  DestructibleBody* body = nullptr;
  double strength = 1;  // of the body beside the material's
  btSoftBody* soft = nullptr;
};

class SoftBody : public testing::TestWithParam<Under> {};

TEST_P(SoftBody, AClothLiesOnASlab) {
  const auto fall = [](Under under) {
    SoftWorld w(9.81);
    w.world.addRigidBody(w.ground.get());
    w.put(under, {12, 2, 12}, {btScalar(-0.3), 0, btScalar(-0.3)});
    w.addCloth(btScalar(0.2), btScalar(0.3));
    w.run(2);
    EXPECT_TRUE(w.destruction->failure().empty()) << w.destruction->failure();
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_EQ(w.body && w.body->isWhole(), under == Under::Whole);
    return std::pair(w.lowest(), w.mean());
  };
  const auto box = fall(Under::OfBullet), own = fall(GetParam());
  EXPECT_NEAR(double(box.second), 0.1 + 0.01, 0.01);  // by its margin above
  EXPECT_NEAR(double(own.first), double(box.first), 0.01);
  EXPECT_NEAR(double(own.second), double(box.second), 0.01);
}

TEST_P(SoftBody, ABallLiesOnASlab) {
  const auto fall = [](Under under) {
    SoftWorld w(9.81);
    w.world.addRigidBody(w.ground.get());
    w.put(under, {12, 2, 12}, {btScalar(-0.3), 0, btScalar(-0.3)});
    w.addBall({0, btScalar(0.25), 0}, 2);
    w.run(2);
    EXPECT_TRUE(w.destruction->failure().empty()) << w.destruction->failure();
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    return std::pair(w.lowest(), w.mean());
  };
  const auto box = fall(Under::OfBullet), own = fall(GetParam());
  EXPECT_NEAR(double(own.first), double(box.first), 0.01);
  EXPECT_NEAR(double(own.second), double(box.second), 0.015);
}

// Without weight, beside what a whole block gets, which nothing strikes hard enough to be elements: Bullet's
// own solver of soft bodies keeps no momentum itself (of 2 kg m/s the two have 2.7 afterwards).
TEST(SoftBlow, GivesElementsWhatItGivesARigidBody) {
  const auto given = [](Under under) {
    SoftWorld w(0);
    w.strength = 10;
    w.put(under, {4, 4, 4}, {btScalar(-0.1), btScalar(-0.2), btScalar(-0.1)});
    w.addBall({0, btScalar(0.15), 0}, 2);
    w.soft->setVelocity({0, -1, 0});
    w.soft->m_cfg.kDP = 0;
    EXPECT_NEAR(w.momentum(), -2, 1e-3);
    w.run(0.3);
    EXPECT_EQ(w.body->isWhole(), under == Under::Whole);
    return double(w.body->linearMomentum().y());
  };
  const double rigid = given(Under::Whole);
  EXPECT_LT(rigid, -1);
  EXPECT_NEAR(given(Under::Elements), rigid, 0.1 * std::abs(rigid));
}

// A slow ball leaves a slab whole; of faster ones it becomes elements before a node is at it, also where that
// goes all its way in a tick, and breaks as one of elements does.
TEST(SoftBlow, BreaksAWholeSlabAsElements) {
  const auto broken = [](Under under, btScalar speed) {
    SoftWorld w(0, {});
    w.put(under, {8, 2, 8}, {btScalar(-0.2), btScalar(-0.1), btScalar(-0.2)});
    w.addBall({0, btScalar(0.3), 0}, 20);
    w.soft->setVelocity({0, -speed, 0});
    w.run(0.1);
    EXPECT_EQ(w.destruction->failure(), "");
    EXPECT_EQ(w.body->isWhole(), under == Under::Whole && speed < 1);
    return int(w.destruction->counts().springsBroken);
  };
  EXPECT_EQ(broken(Under::Whole, btScalar(0.5)), 0);
  for (const btScalar speed : {btScalar(5), btScalar(20), btScalar(40)}) {
    const int ofElements = broken(Under::Elements, speed);
    EXPECT_GT(ofElements, 20) << speed;
    EXPECT_NEAR(broken(Under::Whole, speed), ofElements, 0.1 * ofElements) << speed;
  }
}

INSTANTIATE_TEST_SUITE_P(On, SoftBody, testing::Values(Under::Elements, Under::Whole),
                         [](const auto& tested) {
                           return tested.param == Under::Whole ? "Whole" : "Elements";
                         });

// Those of Bullet's deformable bodies are refused with a message.
TEST(SoftBodyKind, OthersAreNamed) {
  std::vector<std::string> lines;
  SoftWorld w(9.81, [&](LogLevel level, const std::string& text) {
    if (level == LogLevel::Warning) lines.push_back(text);
  });
  w.put(Under::Elements, {4, 4, 4}, {btScalar(-0.1), 0, btScalar(-0.1)});
  w.addCloth(btScalar(0.205), btScalar(0.3));
  w.soft->m_cfg.collisions = btSoftBody::fCollision::SDF_RD;
  w.run(0.1);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("a soft body passes through"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace rubble::test
