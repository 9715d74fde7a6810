// The static state that an asset keeps: the solved one bit by bit after its file, and never believed.
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "edem/prestress.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

template <class Real>
class KeptRest : public ::testing::Test {
 protected:
  // More elements than a sparse Cholesky is taken for, so that a solution counts its iterations.
  edem::BodyDef m_def = block({8, 10, 4}, true);

  static edem::Body<Real> make(const edem::BodyDef& def) { return edem::makeBody<Real>(def, 0); }

  // The same definition with an asset that keeps its state.
  edem::BodyDef keeping() const {
    AssetRest rest;
    const auto body = make(m_def);
    EXPECT_EQ(edem::findRest(body, kGravity, edem::RestMethod::Chosen, rest).outcome,
              edem::PrestressOutcome::Done);
    return with(rest);
  }
  edem::BodyDef with(const AssetRest& rest) const {
    edem::BodyDef def = m_def;
    Asset asset = *m_def.asset;
    asset.rest = rest;
    def.asset = std::make_shared<const Asset>(std::move(asset));
    return def;
  }

  static void expectEqualStates(const edem::Body<Real>& a, const edem::Body<Real>& b) {
    ASSERT_EQ(a.elementCount(), b.elementCount());
    for (std::size_t i = 0; i < a.elementCount(); ++i) {
      EXPECT_EQ(a.state.displacement[i], b.state.displacement[i]) << i;
      EXPECT_EQ(a.state.rotation[i].coeffs(), b.state.rotation[i].coeffs()) << i;
    }
  }

  // Not taken, for a reason that holds the words, and solved as if the asset kept none.
  static void expectSolvedAnew(const edem::BodyDef& def, const Eigen::Vector3d& gravity, const char* words) {
    auto body = make(def);
    const edem::PrestressResult result = edem::prestress(body, gravity);
    EXPECT_EQ(result.outcome, edem::PrestressOutcome::Done) << result.reason;
    EXPECT_GT(result.corrections, 0);
    EXPECT_NE(result.refusal.find(words), std::string::npos) << '"' << result.refusal << '"';
    edem::BodyDef bare = def;
    Asset asset = *def.asset;
    asset.rest.reset();
    bare.asset = std::make_shared<const Asset>(std::move(asset));
    auto solved = make(bare);
    EXPECT_EQ(edem::prestress(solved, gravity).refusal, "");
    expectEqualStates(body, solved);
  }
};
TYPED_TEST_SUITE(KeptRest, Scalars);

TYPED_TEST(KeptRest, FromAFileIsTheSolvedOneAndNothingIsSolved) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) /
      ("rubble_kept_rest_" + std::to_string(sizeof(TypeParam)) + ".rubble-asset");
  save(*this->keeping().asset, file);
  edem::BodyDef def = this->m_def;
  def.asset = std::make_shared<const Asset>(load(file));
  std::filesystem::remove(file);

  auto solved = this->make(this->m_def), taken = this->make(def);
  const edem::PrestressResult first = edem::prestress(solved, kGravity);
  ASSERT_EQ(first.outcome, edem::PrestressOutcome::Done) << first.reason;
  EXPECT_GT(first.iterations, 0);
  const edem::PrestressResult second = edem::prestress(taken, kGravity);
  EXPECT_EQ(second.outcome, edem::PrestressOutcome::Kept) << second.refusal;
  EXPECT_EQ(second.iterations, 0);
  EXPECT_EQ(second.corrections, 0);
  EXPECT_EQ(second.residual, first.residual);
  EXPECT_EQ(second.refusal, "");
  this->expectEqualStates(solved, taken);
}

TYPED_TEST(KeptRest, IsTakenByTheSolverForEveryBodyAndNotKeptTwice) {
  const auto solver = makeSolver<TypeParam>();
  edem::BodyDef def = this->keeping();
  for (const double x : {0.0, 5.0}) {
    def.transform.translation().x() = x;
    const std::uint32_t id = solver->addBody(def, kGravity);
    EXPECT_EQ(solver->prestressed(id).outcome, edem::PrestressOutcome::Kept);
  }
  edem::StaticRestCache cache;
  auto body = this->make(def);
  EXPECT_EQ(edem::prestress(body, kGravity, &cache).outcome, edem::PrestressOutcome::Kept);
  EXPECT_EQ(cache.size(), 0u);
}

TYPED_TEST(KeptRest, OfAnotherBodyIsSolvedAnew) {
  const char* words = "it is of another material, model, gravity, precision or geometry";
  const edem::BodyDef def = this->keeping();
  const std::vector<std::function<void(edem::BodyDef&)>> changes = {
      [](edem::BodyDef& d) { d.material.density *= 2; },
      [](edem::BodyDef& d) { d.material.youngsModulus *= 2; },
      [](edem::BodyDef& d) { d.model.rotationalStiffness = false; },
      [](edem::BodyDef& d) { d.transform.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())); }};
  for (const auto& change : changes) {
    edem::BodyDef other = def;
    change(other);
    this->expectSolvedAnew(other, kGravity, words);
  }
  this->expectSolvedAnew(def, 0.5 * kGravity, words);
  this->expectSolvedAnew(def, Eigen::Vector3d(0.1, -9.81, 0), words);
  // Changed after it was cooked: an anchor less.
  edem::BodyDef loose = def;
  Asset asset = *def.asset;
  asset.anchors.pop_back();
  loose.asset = std::make_shared<const Asset>(std::move(asset));
  this->expectSolvedAnew(loose, kGravity, words);
}

TYPED_TEST(KeptRest, OfTheOtherPrecisionIsSolvedAnew) {
  using Other = std::conditional_t<std::is_same_v<TypeParam, float>, double, float>;
  auto body = edem::makeBody<Other>(this->keeping(), 0);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  EXPECT_EQ(result.outcome, edem::PrestressOutcome::Done);
  EXPECT_NE(result.refusal, "");
}

// The right key, and numbers that a file may hold: only the residual tells.
TYPED_TEST(KeptRest, ThatDoesNotBalanceIsSolvedAnew) {
  const AssetRest right = *this->keeping().asset->rest;
  AssetRest moved = right, turned = right, none = right;
  moved.displacements[100] *= 1.001;
  turned.rotations[100] = Eigen::AngleAxisd(1e-6, Eigen::Vector3d::UnitZ()) * turned.rotations[100];
  for (auto& displacement : none.displacements) displacement.setZero();
  for (const AssetRest& wrong : {moved, turned, none})
    this->expectSolvedAnew(this->with(wrong), kGravity,
                           "of an element's weight unbalanced, allowed is 1e-06");
}

TYPED_TEST(KeptRest, OfOneThatCannotBeSolvedIsNotTakenEither) {
  edem::BodyDef def = this->keeping();
  def.material.youngsModulus = 1e3;  // rho g H = 47 kPa
  auto body = this->make(def);
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  EXPECT_EQ(result.outcome, edem::PrestressOutcome::Failed);
  EXPECT_NE(result.refusal, "");
  for (const auto& u : body.state.displacement) EXPECT_EQ(u.norm(), TypeParam(0));
}

TYPED_TEST(KeptRest, IsOfAWholeBodyOnly) {
  auto body = this->make(this->keeping());
  // An anchor of many breaks.
  body.state.intact.back() = 0;
  ++body.state.brokenCount;
  --body.state.anchorsIntact;
  const edem::PrestressResult result = edem::prestress(body, kGravity);
  EXPECT_EQ(result.outcome, edem::PrestressOutcome::Done) << result.reason;
  EXPECT_EQ(result.refusal, "") << "it was not asked for";
}

TYPED_TEST(KeptRest, IsRefusedOnceForEqualBodies) {
  const auto solver = makeSolver<TypeParam>();
  edem::BodyDef def = this->keeping();
  def.material.density *= 2;
  const std::uint32_t first = solver->addBody(def, kGravity), second = solver->addBody(def, kGravity);
  EXPECT_NE(solver->prestressed(first).refusal, "");
  EXPECT_EQ(solver->prestressed(second).outcome, edem::PrestressOutcome::Cached);
  EXPECT_EQ(solver->prestressed(second).refusal, "");
}

}  // namespace
}  // namespace rubble::test
