// A heavy ball through a standing wall: everything at once, and the ledger closes.
#include <algorithm>

#include "physics/bodies.h"

namespace rubble::test {
namespace {

template <class Real>
class Impact : public ::testing::Test {
 protected:
  static constexpr double kMass = 500, kSpeed = 12;

  void SetUp() override {
    edem::BodyDef def = block({6, 5, 1}, true);
    def.material.springDamping = 0.03;
    def.material.contactDamping = 0.3;
    def.material.friction = 0.6;
    def.crushEnergy.assign(def.asset->elementCount(), 60);
    id = solver->addBody(def, kGravity);
    proxies.push_back(ball(0.25, kMass, {0.62, 0.57, 0.5}, {0, 0, -kSpeed}));
    proxies[0].acceleration = kGravity;
    // The ground that the anchors stand on.
    edem::RigidProxy ground;
    edem::Collider plane;
    plane.kind = edem::Collider::Kind::Plane;
    plane.size = Eigen::Vector3d::UnitY();
    ground.parts = {plane};
    proxies.push_back(ground);
    for (int t = 0; t < 45; ++t) {
      solver->tick(kFrame, kGravity, proxies);
      for (const edem::RigidProxy& p : proxies) given += p.impulse;
    }
    ASSERT_EQ(solver->failure(), "");
  }
  static constexpr bool kIsFloat = std::is_same_v<Real, float>;
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>();
  std::uint32_t id = 0;
  std::vector<edem::RigidProxy> proxies;
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
};
TYPED_TEST_SUITE(Impact, Scalars);

TYPED_TEST(Impact, BreaksAndCrushesTheWall) {
  const edem::BodyView view = this->solver->view(this->id);
  EXPECT_GT(view.broken, 10u);
  EXPECT_GT(view.crushed, 0u);
  EXPECT_LT(view.crushed, 30u);
  EXPECT_GT(this->proxies[0].velocity.z(), -this->kSpeed);
}

TYPED_TEST(Impact, EnergyLedgerCloses) {
  const edem::Books& b = this->solver->books();
  // `dissipated` is work on the elements: negative where energy is lost.
  EXPECT_LT(b.dissipated.done(), 0);
  const double now =
      b.kinetic + b.elastic - b.dissipated.done() + b.fracture + b.massDamped + b.leftKinetic + b.leftElastic;
  const double had = b.initialEnergy + b.gravity.work.done() + b.bullet.work.done() + b.anchors.work.done();
  const double scale = 0.5 * this->kMass * this->kSpeed * this->kSpeed;
  // The exact balance of leapfrog holds for linear springs; finite rotations and contacts that open within a
  // substep leave a few thousandths of the impact.
  EXPECT_NEAR(now, had, 5e-3 * scale) << now << " " << had;
}

TYPED_TEST(Impact, MomentumLedgerCloses) {
  const edem::Books& b = this->solver->books();
  const double tolerance = this->kIsFloat ? 1e-4 : 1e-9;
  const double size = this->kMass * this->kSpeed;  // of the ball: the most that there was
  const Eigen::Vector3d linear =
      b.linear + b.leftLinear - b.initialLinear - b.gravity.linear - b.bullet.linear - b.anchors.linear;
  EXPECT_LT(linear.norm(), tolerance * size);
  const Eigen::Vector3d angular =
      b.angular + b.leftAngular - b.initialAngular - b.gravity.angular - b.bullet.angular - b.anchors.angular;
  EXPECT_LT(angular.norm(), tolerance * size * b.diagonal);
}

TYPED_TEST(Impact, RigidBodiesGetTheOppositeImpulse) {
  const edem::Books& b = this->solver->books();
  EXPECT_LT((this->given + b.bullet.linear).norm(), 1e-9 * b.bullet.size);
}

TYPED_TEST(Impact, MassLedgerCloses) {
  const edem::Books& b = this->solver->books();
  EXPECT_NEAR(b.mass + b.leftMass, b.initialMass, 1e-12 * b.initialMass);
}

}  // namespace
}  // namespace rubble::test
