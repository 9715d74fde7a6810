// The same statements for a packed body: irregular cells, unequal masses, spheres that overlap a little at
// rest.
#include "edem/prestress.h"
#include "physics/bodies.h"
#include "rubble/cook.h"
#include "support/strict_cook.h"

namespace rubble::test {
namespace {

edem::BodyDef packedColumn(bool anchored) {
  static const auto asset = [] {
    CookOptions options;
    options.elements = 120;
    options.anchorDirection = -Eigen::Vector3d::UnitY();
    return std::make_shared<const Asset>(cookStrictly(boxMesh({0.5, 1.5, 0.5}), options));
  }();
  edem::BodyDef def;
  def.asset = asset;
  def.anchored = anchored;
  def.material.springDamping = 0;
  return def;
}

template <class Real>
class PackedBody : public ::testing::Test {};
TYPED_TEST_SUITE(PackedBody, Scalars);

TYPED_TEST(PackedBody, WeighsWhatItsSolidWeighs) {
  const auto solver = makeSolver<TypeParam>();
  const edem::BodyDef def = packedColumn(false);
  solver->addBody(def, kNoGravity);
  EXPECT_NEAR(solver->books().mass, def.material.density * 0.375, 1e-6 * 900);
}

TYPED_TEST(PackedBody, RestsWithoutForceInFreeFlight) {
  // Neither pairs that overlap at rest nor springs do anything: what floats, floats.
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(packedColumn(false), kNoGravity);
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kNoGravity, {});
  EXPECT_LT(solver->maxSpeed(id), 1e-6);
}

TYPED_TEST(PackedBody, AnchoredStandsStillWithoutDamping) {
  auto body = edem::makeBody<TypeParam>(packedColumn(true), 0);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  ASSERT_EQ(result.outcome, edem::PrestressOutcome::Done) << result.reason;
  EXPECT_LT(result.residual, 1e-6);
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(packedColumn(true), kGravity);
  double fastest = 0;
  for (int t = 0; t < 60; ++t) {
    solver->tick(kFrame, kGravity, {});
    fastest = std::max(fastest, solver->maxSpeed(id));
  }
  EXPECT_LT(fastest, 1e-3);
  EXPECT_EQ(solver->view(id).broken, 0u);
}

TYPED_TEST(PackedBody, SpinningKeepsAngularMomentum) {
  edem::BodyDef def = packedColumn(false);
  def.spin = Eigen::Vector3d(4, 3, 2);
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  for (int t = 0; t < 120; ++t) solver->tick(kFrame, kNoGravity, {});
  const edem::Books& b = solver->books();
  EXPECT_LT((b.angular - b.initialAngular).norm(), 1e-5 * b.initialAngular.norm());
  EXPECT_EQ(solver->view(id).fragments, 1u);
}

TYPED_TEST(PackedBody, ShotToPiecesKeepsItsLedger) {
  edem::BodyDef def = packedColumn(true);
  def.material.springDamping = 0.03;
  def.crushEnergy.assign(def.asset->elementCount(), 20);
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kGravity);
  std::vector<edem::RigidProxy> proxies = {ball(0.2, 300, {0.02, 0.1, 0.6}, {0, 0, -15})};
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kGravity, proxies);
  const edem::BodyView view = solver->view(id);
  EXPECT_GT(view.broken, 20u);
  EXPECT_GT(view.crushed, 0u);
  const edem::Books& b = solver->books();
  const double now = b.kinetic + b.elastic - b.dissipated.done() + b.fracture + b.leftKinetic + b.leftElastic;
  const double had = b.initialEnergy + b.gravity.work.done() + b.bullet.work.done();
  EXPECT_NEAR(now, had, 5e-3 * 0.5 * 300 * 15 * 15);
  const Eigen::Vector3d linear =
      b.linear + b.leftLinear - b.initialLinear - b.gravity.linear - b.bullet.linear - b.anchors.linear;
  const double size = b.gravity.size + b.bullet.size + b.anchors.size;
  EXPECT_LT(linear.norm(), (std::is_same_v<TypeParam, float> ? 1e-4 : 1e-9) * size);
}

}  // namespace
}  // namespace rubble::test
