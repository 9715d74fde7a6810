// An anchored body stands from its first step.
#include "edem/prestress.h"

#include <string>
#include <vector>

#include "physics/bodies.h"
#include "rubble/cook.h"

namespace rubble::test {
namespace {

template <class Real>
class Prestress : public ::testing::Test {};
TYPED_TEST_SUITE(Prestress, Scalars);

TYPED_TEST(Prestress, UndampedColumnStandsStillFromTheFirstTick) {
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(block({2, 10, 2}, true), kGravity);
  double fastest = 0;
  for (int t = 0; t < 120; ++t) {
    solver->tick(kFrame, kGravity, {});
    fastest = std::max(fastest, solver->maxSpeed(id));
  }
  EXPECT_LT(fastest, 1e-3);
  EXPECT_EQ(solver->view(id).broken, 0u);
  EXPECT_EQ(solver->view(id).fragments, 1u);
}

TYPED_TEST(Prestress, AnchorsCarryTheWeight) {
  const auto solver = makeSolver<TypeParam>();
  solver->addBody(block({2, 10, 2}, true), kGravity);
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kGravity, {});
  const edem::Books& books = solver->books();
  EXPECT_NEAR(books.gravity.linear.y(), -9.81 * books.mass * 0.5, 1e-6 * books.gravity.size);
  EXPECT_NEAR(books.anchors.linear.y(), -books.gravity.linear.y(), 1e-4 * books.gravity.size);
}

TYPED_TEST(Prestress, LeavesNoResidualForce) {
  auto body = edem::makeBody<TypeParam>(block({5, 6, 1}, true), 0);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  EXPECT_EQ(result.outcome, edem::PrestressOutcome::Done) << result.reason;
  EXPECT_LT(result.residual, 1e-6);  // of an element's weight
}

// A lattice of cubes has no Poisson's ratio: a column of n elements under its own weight is n springs in a
// row, spring j carries (n - j) elements; the anchor is half a spring long and so twice as stiff.
double settlementOfColumn(const edem::Body<double>& body) {
  const double weight = 9.81 * body.constants->mass[0], k = body.constants->material.youngsModulus * 0.2;
  const auto n = int(body.elementCount());
  double sum = n * weight / (2 * k);
  for (int j = 1; j < n; ++j) sum += (n - j) * weight / k;
  return sum;
}

TEST(PrestressedColumn, SettlesAsAUniformColumn) {
  for (const auto method : {edem::RestMethod::Direct, edem::RestMethod::Grouped}) {
    auto body = edem::makeBody<double>(block({1, 10, 1}, true), 0);
    ASSERT_TRUE(edem::prestress(body, kGravity, nullptr, method).applied());
    const double expected = settlementOfColumn(body);
    EXPECT_NEAR(-body.state.displacement[9].y(), expected, 1e-6 * expected);
  }
}

TEST(PrestressedColumn, TallAndHeavySettlesAsAUniformColumn) {
  // 80 m of cubes of 0.2 m, ten times concrete's stiffness: its top settles by 105 mm.
  edem::BodyDef def = block({1, 400, 1}, true);
  def.material.youngsModulus = 300e6;
  auto body = edem::makeBody<double>(def, 0);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  // A slender column buckles; as a perfectly straight one it has a state all the same.
  ASSERT_TRUE(result.applied()) << result.reason;
  const double expected = settlementOfColumn(body);
  EXPECT_NEAR(-body.state.displacement[399].y(), expected, 1e-6 * expected);
}

TEST(PrestressedColumn, WithoutRotationalStiffnessIsAStateToo) {
  // Nothing holds its elements' rotations but a tiny diagonal.
  edem::BodyDef def = block({1, 10, 1}, true);
  def.model = Model::paper();
  for (const auto method : {edem::RestMethod::Direct, edem::RestMethod::Grouped}) {
    auto body = edem::makeBody<double>(def, 0);
    const edem::PrestressResult result = edem::prestress(body, kGravity, nullptr, method);
    ASSERT_TRUE(result.applied()) << result.reason;
    const double expected = settlementOfColumn(body);
    EXPECT_NEAR(-body.state.displacement[9].y(), expected, 1e-6 * expected);
  }
}

TEST(PrestressFails, ChainWithoutStiffnessAcrossItsGravity) {
  // A chain that lies on its side without k_rot: no spring holds it.
  edem::BodyDef def = block({1, 10, 1}, true);
  def.model = Model::paper();
  for (const auto method : {edem::RestMethod::Direct, edem::RestMethod::Grouped}) {
    auto body = edem::makeBody<double>(def, 0);
    const edem::PrestressResult result = edem::prestress(body, Eigen::Vector3d(9.81, 0, 0), nullptr, method);
    EXPECT_EQ(result.outcome, edem::PrestressOutcome::Failed);
    EXPECT_NE(result.reason, "");
    for (const auto& u : body.state.displacement) EXPECT_EQ(u.norm(), 0);
  }
}

TYPED_TEST(Prestress, TooHeavyForItsStiffnessIsLeftAsItWas) {
  edem::BodyDef def = block({1, 10, 1}, true);
  def.material.youngsModulus = 1e3;  // rho g H = 47 kPa
  auto body = edem::makeBody<TypeParam>(def, 0);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  EXPECT_EQ(result.outcome, edem::PrestressOutcome::Failed);
  EXPECT_NE(result.reason.find("too heavy"), std::string::npos) << result.reason;
  for (const auto& u : body.state.displacement) EXPECT_EQ(u.norm(), TypeParam(0));
  for (const auto& q : body.state.rotation) EXPECT_EQ(q.w(), TypeParam(1));
}

TYPED_TEST(Prestress, DoesNothingWithoutAnAnchor) {
  auto body = edem::makeBody<TypeParam>(block({2, 2, 2}), 0);
  EXPECT_EQ(edem::prestress(body, kGravity).outcome, edem::PrestressOutcome::NotAnchored);
  for (const auto& u : body.state.displacement) EXPECT_EQ(u.norm(), TypeParam(0));
}

// Takes an element's springs away, and the element too if it is crushed.
template <class Real>
void cutOut(edem::Body<Real>& body, std::uint32_t element, bool crushed) {
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) {
    if (body.state.springs[s].first != element && body.state.springs[s].second != element) continue;
    body.state.intact[s] = 0;
    ++body.state.brokenCount;
    if (body.isAnchor(s)) --body.state.anchorsIntact;
  }
  body.state.alive[element] = !crushed;
  body.state.crushedCount += crushed;
  edem::labelFragments(body);
}

TYPED_TEST(Prestress, GoesRoundCrushedElements) {
  for (const auto method : {edem::RestMethod::Direct, edem::RestMethod::Grouped}) {
    auto body = edem::makeBody<TypeParam>(block({4, 6, 4}, true), 0);
    cutOut(body, 37, true);
    const edem::PrestressResult result = edem::prestress(body, kGravity, nullptr, method);
    ASSERT_EQ(result.outcome, edem::PrestressOutcome::Done) << result.reason;
    EXPECT_EQ(body.state.displacement[37].norm(), TypeParam(0));
  }
}

TYPED_TEST(Prestress, DoesNothingWhenAPartHangsOnNoAnchor) {
  auto body = edem::makeBody<TypeParam>(block({4, 6, 4}, true), 0);
  cutOut(body, 37, false);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  EXPECT_EQ(result.outcome, edem::PrestressOutcome::NotAnchored);
  EXPECT_NE(result.reason.find("no anchor"), std::string::npos);
}

double farthestApart(const edem::Body<double>& a, const edem::Body<double>& b) {
  double apart = 0;
  for (std::size_t i = 0; i < a.elementCount(); ++i)
    apart = std::max(apart, (a.state.displacement[i] - b.state.displacement[i]).norm());
  return apart;
}

TEST(PrestressMethods, AgreeOnAWallThatBends) {
  CookOptions options;
  options.elements = 600;
  options.anchorDirection = -Eigen::Vector3d::UnitY();
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(cook(boxMesh({1, 1, 0.08}), options));
  auto direct = edem::makeBody<double>(def, 0), grouped = edem::makeBody<double>(def, 0);
  const Eigen::Vector3d leaning(0.3, -9.8, 0.3);
  const auto a = edem::prestress(direct, leaning, nullptr, edem::RestMethod::Direct);
  const auto b = edem::prestress(grouped, leaning, nullptr, edem::RestMethod::Grouped);
  ASSERT_TRUE(a.applied()) << a.reason;
  ASSERT_TRUE(b.applied()) << b.reason;
  EXPECT_EQ(a.iterations, 0);
  EXPECT_GT(b.iterations, 0);
  double largest = 0;
  for (const auto& u : direct.state.displacement) largest = std::max(largest, u.norm());
  // Both leave 1e-6 of an element's weight, and there are 600.
  EXPECT_LT(farthestApart(direct, grouped), 1e-4 * largest);
  auto again = edem::makeBody<double>(def, 0);
  edem::prestress(again, leaning, nullptr, edem::RestMethod::Grouped);
  EXPECT_EQ(farthestApart(grouped, again), 0) << "must not depend on anything but the body";
}

TEST(PrestressMethods, IterationsHardlyGrowWithTheWall) {
  // The groups carry what is long: a wall of 128 x 128 cubes, one thick and leaning, as one of 32 x 32.
  std::vector<int> iterations;
  for (const int n : {32, 128}) {
    edem::BodyDef def = block({n, n, 1}, true, 1.0 / n);
    def.material.youngsModulus = 30e9;
    auto body = edem::makeBody<float>(def, 0);
    const auto result = edem::prestress(body, Eigen::Vector3d(0, -9.81, 0.01));
    ASSERT_TRUE(result.applied()) << result.reason;
    iterations.push_back(result.iterations / result.corrections);
  }
  EXPECT_LT(iterations[1], 3 * iterations[0]);
}

TYPED_TEST(Prestress, EqualBodiesAreSolvedOnce) {
  const auto solver = makeSolver<TypeParam>();
  edem::BodyDef def = block({2, 10, 2}, true);
  const auto outcome = [&](std::uint32_t id) { return solver->prestressed(id).outcome; };
  const std::uint32_t first = solver->addBody(def, kGravity);
  EXPECT_EQ(outcome(first), edem::PrestressOutcome::Done);
  def.transform.translation() = Eigen::Vector3d(5, 0, 0);
  const std::uint32_t second = solver->addBody(def, kGravity);
  EXPECT_EQ(outcome(second), edem::PrestressOutcome::Cached);
  EXPECT_EQ(solver->prestressed(second).residual, solver->prestressed(first).residual);
  def.material.density *= 2;
  EXPECT_EQ(outcome(solver->addBody(def, kGravity)), edem::PrestressOutcome::Done) << "of another weight";
  EXPECT_EQ(outcome(solver->addBody(def, 0.5 * kGravity)), edem::PrestressOutcome::Done) << "less gravity";
  def.anchored = false;
  EXPECT_EQ(outcome(solver->addBody(def, kGravity)), edem::PrestressOutcome::NotNeeded);
}

TYPED_TEST(Prestress, ACachedStateIsTheSolvedOneBitByBit) {
  edem::StaticRestCache cache;
  const edem::BodyDef def = block({3, 8, 2}, true);
  auto solved = edem::makeBody<TypeParam>(def, 0), taken = edem::makeBody<TypeParam>(def, 1);
  ASSERT_EQ(edem::prestress(solved, kGravity, &cache).outcome, edem::PrestressOutcome::Done);
  ASSERT_EQ(edem::prestress(taken, kGravity, &cache).outcome, edem::PrestressOutcome::Cached);
  EXPECT_EQ(cache.size(), 1u);
  for (std::size_t i = 0; i < solved.elementCount(); ++i) {
    EXPECT_EQ(solved.state.displacement[i], taken.state.displacement[i]);
    EXPECT_EQ(solved.state.rotation[i].coeffs(), taken.state.rotation[i].coeffs());
  }
}

TEST(PrestressCache, ForgetsAssetsThatAreGone) {
  edem::StaticRestCache cache;
  for (int n = 0; n < 3; ++n) {
    auto body = edem::makeBody<double>(block({1, 2, 1}, true), 0);
    EXPECT_EQ(edem::prestress(body, kGravity, &cache).outcome, edem::PrestressOutcome::Done);
  }
  EXPECT_EQ(cache.size(), 1u);
}

TYPED_TEST(Prestress, ATurnedBodyStandsStillToo) {
  // Lying on its side against gravity along its own axis: the asset's state is turned with the body.
  edem::BodyDef def = block({2, 10, 2}, true);
  def.transform.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto solver = makeSolver<TypeParam>(false);  // two metres of it break under their weight
  const std::uint32_t id = solver->addBody(def, kGravity);
  ASSERT_EQ(solver->prestressed(id).outcome, edem::PrestressOutcome::Done) << solver->prestressed(id).reason;
  double fastest = 0;
  for (int t = 0; t < 60; ++t) {
    solver->tick(kFrame, kGravity, {});
    fastest = std::max(fastest, solver->maxSpeed(id));
  }
  EXPECT_LT(fastest, 1e-3);
}

}  // namespace
}  // namespace rubble::test
