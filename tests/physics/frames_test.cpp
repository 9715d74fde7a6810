// Fragments far from where their body was made. At 30 GPa a float place is noise three metres away, and a
// displacement of a metre rounds what moves less than 6e-8 m in a substep to nothing: each needs a frame of
// its own.
#include <algorithm>
#include <functional>
#include <limits>

#include "edem/frames.h"
#include "edem/stages.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

constexpr int kAlong = 4;  // elements along x
constexpr double kElementEdge = 0.05;

bool isRight(std::size_t element) {
  return element % kAlong >= kAlong / 2;
}

// Two blocks of 2 x 2 x 2 concrete cubes, 12 springs each, that lie against one another unjoined.
edem::BodyDef halves(bool leftAnchored, double edge = kElementEdge) {
  GridAssetDef grid;
  grid.cubes = {kAlong, 2, 2};
  grid.edge = edge;
  grid.anchored = leftAnchored;
  Asset asset = gridAsset(grid);
  std::erase_if(asset.springs, [](const AssetSpring& s) { return isRight(s.first) != isRight(s.second); });
  std::erase_if(asset.anchors, [](const AssetAnchor& a) { return isRight(a.element); });
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(std::move(asset));
  def.material = material("concrete");
  def.anchored = leftAnchored;
  return def;
}

// One body of two halves in a world of its own.
template <class Real>
class Halves {
 public:
  void add(const edem::BodyDef& def) { solver->addBody(def, kNoGravity); }
  void tick(int count) {
    for (int t = 0; t < count; ++t) solver->tick(kFrame, kNoGravity, {});
  }
  // Adds a velocity to every element of one half.
  void push(bool right, const Eigen::Vector3d& velocity) {
    const edem::BodyView view = solver->view(0);
    for (std::size_t i = 0; i < view.mass.size(); ++i)
      if (isRight(i) == right) solver->push(0, i, view.mass[i] * velocity, Eigen::Vector3d::Zero());
  }
  double meanOf(bool right, const std::function<double(std::size_t)>& value) const {
    double sum = 0;
    for (std::size_t i = 0; i < 16; ++i) sum += isRight(i) == right ? value(i) / 8 : 0;
    return sum;
  }
  double placeOf(bool right) const {
    return meanOf(right, [&](std::size_t i) { return solver->position(0, i).x(); });
  }
  // What the rounding of displacements may add up to over so many ticks: half an ulp of the scalar in every
  // substep, of the way of one tick at 10 m/s.
  double rounding(int ticks) const {
    const double half = 0.5 * double(std::numeric_limits<Real>::epsilon()) * 10 * kFrame;
    return ticks * solver->report().substeps * half;
  }
  double speedOf(bool right) const {
    return meanOf(right, [&](std::size_t i) { return solver->velocity(0, i).x(); });
  }

  std::unique_ptr<edem::Solver> solver = makeSolver<Real>();
};

template <class Real>
class Frames : public ::testing::Test {
 protected:
  Halves<Real> run;
};
TYPED_TEST_SUITE(Frames, Scalars);

TYPED_TEST(Frames, HalvesFlyFarWithoutBreaking) {
  this->run.add(halves(false));
  ASSERT_EQ(this->run.solver->view(0).intact.size(), 24u);
  const double left = this->run.placeOf(false), right = this->run.placeOf(true);
  this->run.push(false, {-10, 0, 0});
  this->run.push(true, {10, 0, 0});
  this->run.tick(60);
  ASSERT_EQ(this->run.solver->failure(), "");
  EXPECT_EQ(this->run.solver->view(0).broken, 0u);
  EXPECT_EQ(this->run.solver->view(0).fragments, 2u);
  const double rounding = std::max(this->run.rounding(60), 1e-9);
  EXPECT_NEAR(this->run.placeOf(false), left - 10, rounding);
  EXPECT_NEAR(this->run.placeOf(true), right + 10, rounding);
}

TYPED_TEST(Frames, AHalfFliesFarFromTheAnchoredOneWithoutBreaking) {
  this->run.add(halves(true));
  const double left = this->run.placeOf(false), right = this->run.placeOf(true);
  this->run.push(true, {10, 0, 0});
  this->run.tick(60);
  ASSERT_EQ(this->run.solver->failure(), "");
  EXPECT_EQ(this->run.solver->view(0).broken, 0u);
  const double rounding = std::max(this->run.rounding(60), 1e-9);
  EXPECT_NEAR(this->run.placeOf(false), left, rounding);
  EXPECT_NEAR(this->run.placeOf(true), right + 10, rounding);
}

TYPED_TEST(Frames, AHalfSpinningFarAwayDoesNotBreak) {
  this->run.add(halves(true));
  // Fast enough that no corner turns into the other half.
  this->run.push(true, {10, 0, 0});
  const edem::BodyView view = this->run.solver->view(0);
  const Eigen::Vector3d spin(0, 5, 3), centre(3 * kElementEdge, kElementEdge, kElementEdge);
  for (std::size_t i = 0; i < view.mass.size(); ++i) {
    if (!isRight(i)) continue;
    const Eigen::Vector3d v = spin.cross(this->run.solver->position(0, i) - centre);
    this->run.solver->push(0, i, view.mass[i] * v, view.inertia[i] * spin);
  }
  this->run.tick(60);
  ASSERT_EQ(this->run.solver->failure(), "");
  EXPECT_EQ(this->run.solver->view(0).broken, 0u);
  EXPECT_NEAR(this->run.speedOf(true), 10, 1e-4);
}

TYPED_TEST(Frames, SlowMotionFarFromTheAnchorGoesAtItsSpeed) {
  constexpr double kSlow = 0.015;
  this->run.add(halves(true, 0.03));
  this->run.push(true, {10, 0, 0});
  this->run.tick(7);
  this->run.push(true, {kSlow - this->run.speedOf(true), 0, 0});
  const double from = this->run.placeOf(true);
  ASSERT_GT(from, 1);
  this->run.tick(20);
  ASSERT_LT(kSlow * this->run.solver->report().substep, 6e-8) << "half an ulp of 1 m, or this tests nothing";
  const double way = 20 * kFrame * kSlow;
  EXPECT_NEAR(this->run.placeOf(true) - from, way, 1e-3 * way);
}

TYPED_TEST(Frames, FragmentsMeetFarAwayAsTheyDoNear) {
  // No losses, so that nothing covers a difference.
  const auto after = [](double flight) {
    Halves<TypeParam> pair;
    edem::BodyDef def = halves(false);
    def.material.springDamping = def.material.contactDamping = 0;
    def.material.restitution = 1;
    pair.add(def);
    pair.push(false, {-0.1, flight, 0});
    pair.push(true, {0.1, flight, 0});
    pair.tick(12);
    pair.push(false, {0.2, -flight, 0});
    pair.push(true, {-0.2, -flight, 0});
    pair.tick(24);
    EXPECT_EQ(pair.solver->view(0).broken, 0u);
    return pair.speedOf(true);
  };
  const double near = after(0);
  EXPECT_GT(near, 0.05) << "they have met";
  EXPECT_NEAR(after(50), near, 1e-3 * near);  // 10 m away
}

// What a change of frames may not change.
template <class Real>
struct StateSums {
  std::vector<Eigen::Vector3d> places, velocities;
  std::vector<Eigen::Quaterniond> turns;
  double elastic = 0;

  explicit StateSums(const edem::Body<Real>& body) {
    for (std::size_t i = 0; i < body.elementCount(); ++i) {
      places.push_back(body.worldPosition(i));
      velocities.push_back(body.state.velocity[i].template cast<double>());
      turns.push_back(body.orientation(i));
    }
    edem::Body<Real> copy = body;
    edem::Books books;
    edem::beginSubstep(copy.state, copy.work);
    elastic = edem::accumulateSprings(copy, copy.work, 0, false, books);
    for (std::size_t i = 0; i < body.elementCount(); ++i)
      EXPECT_LT((body.state.origin + copy.work.position[i] - places[i]).norm(), 1e-15) << i;
  }
};

// A turned body, one half anchored, torn in the middle, each element somewhere else.
template <class Real>
edem::Body<Real> tornBody() {
  GridAssetDef grid;
  grid.cubes = {kAlong, 2, 2};
  grid.edge = kElementEdge;
  grid.anchored = true;
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(gridAsset(grid));
  def.transform.linear() =
      Eigen::Quaterniond(Eigen::Vector4d(0.1, -0.3, 0.5, 0.8).normalized()).toRotationMatrix();
  edem::Body<Real> body = edem::makeBody<Real>(def, 0);
  Numbers numbers;
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.state.displacement[i] = numbers.vector(0.01).cast<Real>();
    body.state.velocity[i] = numbers.vector(1).cast<Real>();
    const Eigen::Vector3d half = numbers.vector(0.05);
    body.state.rotation[i] =
        edem::Quat<Real>(edem::Quat<double>(1, half.x(), half.y(), half.z()).normalized().cast<Real>());
  }
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) {
    const edem::Spring<Real>& spring = body.state.springs[s];
    const bool torn =
        body.isAnchor(s) ? isRight(spring.first) : isRight(spring.first) != isRight(spring.second);
    if (torn) body.state.intact[s] = 0;
  }
  edem::labelFragments(body);
  return body;
}

template <class Real>
void expectSame(const StateSums<Real>& a, const StateSums<Real>& b, double rounding, double energy) {
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    EXPECT_LT((a.places[i] - b.places[i]).norm(), rounding) << i;
    EXPECT_LT(a.turns[i].angularDistance(b.turns[i]), 10 * rounding) << i;
    EXPECT_EQ(a.velocities[i], b.velocities[i]) << i;
  }
  EXPECT_NEAR(a.elastic, b.elastic, energy * a.elastic);
}

TYPED_TEST(Frames, SplittingChangesNothing) {
  using Real = TypeParam;
  edem::Body<Real> body = tornBody<Real>();
  const std::vector<edem::Vec3<Real>> before = body.state.displacement;
  const StateSums<Real> whole(body);
  edem::splitFrames(body);
  ASSERT_EQ(body.state.frames.size(), 2u);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    EXPECT_EQ(body.state.frameOf[i], isRight(i) ? 1u : 0u);
    EXPECT_EQ(body.state.displacement[i], before[i]);
  }
  const StateSums<Real> split(body);
  EXPECT_EQ(split.elastic, whole.elastic);
  expectSame(whole, split, 1e-15, 0);

  edem::fitFrames(body);
  // Displacements of 1 cm in their scalar, and gaps of that size between them.
  const double ulp = double(std::numeric_limits<Real>::epsilon());
  expectSame(whole, StateSums<Real>(body), std::max(0.02 * ulp, 1e-15), 20 * ulp);
}

TYPED_TEST(Frames, FittingTakesTheMeanMotionOfEachFragment) {
  using Real = TypeParam;
  edem::Body<Real> body = tornBody<Real>();
  edem::splitFrames(body);
  const std::vector<edem::Vec3<Real>> before = body.state.displacement;
  edem::fitFrames(body);
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (isRight(i)) {
      shift += body.state.displacement[i].template cast<double>() / 8;
      turn += body.state.rotation[i].vec().template cast<double>() / 8;
    } else {
      EXPECT_EQ(body.state.displacement[i], before[i]) << "the anchored half's frame stands";
    }
  }
  // Of 1 cm and 0.05 rad.
  const double ulp = double(std::numeric_limits<Real>::epsilon());
  EXPECT_LT(shift.norm(), 0.01 * ulp);
  EXPECT_LT(turn.norm(), 0.05 * ulp);
}

TYPED_TEST(Frames, ACrushedElementStaysWhereItWas) {
  using Real = TypeParam;
  edem::Body<Real> body = tornBody<Real>();
  edem::splitFrames(body);
  edem::fitFrames(body);
  constexpr std::uint32_t kCrushed = kAlong - 1;
  const Eigen::Vector3d place = body.worldPosition(kCrushed);
  const Eigen::Quaterniond turn = body.orientation(kCrushed);
  body.state.alive[kCrushed] = 0;
  for (std::size_t s = 0; s < body.state.springs.size(); ++s)
    if (body.state.springs[s].first == kCrushed || body.state.springs[s].second == kCrushed)
      body.state.intact[s] = 0;
  edem::labelFragments(body);
  edem::splitFrames(body);
  for (auto& u : body.state.displacement) u.x() += Real(1);
  body.state.displacement[kCrushed].x() -= Real(1);
  edem::fitFrames(body);
  EXPECT_EQ(body.state.frameOf[kCrushed], 0u);
  const double ulp = double(std::numeric_limits<Real>::epsilon());
  EXPECT_LT((body.worldPosition(kCrushed) - place).norm(), 3 * ulp);  // it had 1 m added and taken
  EXPECT_LT(body.orientation(kCrushed).angularDistance(turn), 3 * ulp);
}

}  // namespace
}  // namespace rubble::test
