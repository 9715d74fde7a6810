// How high things bounce: Poisson's hypothesis, a blow gives back e^2 of its energy.
#include <numbers>

#include "edem/fragment_motion.h"
#include "physics/bodies.h"
#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

// How high the centre of a block comes back after a fall of `height` on a plane, above where it was when the
// block touched the plane [m]. Its lowest corner is the origin.
template <class Real>
double bounce(edem::BodyDef def, double restitution, double height, double tilt = 0) {
  def.material.restitution = restitution;
  def.transform = Eigen::Translation3d(0, height, 0) * Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitZ());
  const auto solver = makeSolver<Real>(false);
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {fixedPlane()};
  proxies[0].restitution = 1;
  double highest = 0;
  bool fell = false;
  const auto centre = [&] {
    double y = 0;
    for (std::size_t i = 0; i < def.asset->elementCount(); ++i) y += solver->position(id, i).y();
    return y / double(def.asset->elementCount());
  };
  const double touching = centre() - height;
  const int ticks = int(3 * std::sqrt(2 * height / 9.81) * 240);
  for (int t = 0; t < ticks; ++t) {
    solver->tick(1.0 / 240, kGravity, proxies);
    fell = fell || proxies[0].contactWeight > 0;
    // Not in the tick of the landing, at whose end it may not have come down yet.
    if (fell && !(proxies[0].contactWeight > 0)) highest = std::max(highest, centre() - touching);
  }
  EXPECT_TRUE(fell);
  return highest;
}

template <class Real>
class Restitution : public ::testing::Test {};
TYPED_TEST_SUITE(Restitution, Scalars);

TYPED_TEST(Restitution, OneElementGivesBackItsSquare) {
  for (const double e : {0.0, 0.3, 0.5, 0.8, 1.0})
    EXPECT_NEAR(bounce<TypeParam>(block({1, 1, 1}), e, 1), e * e, 0.01 + 0.02 * e * e) << e;
}

TYPED_TEST(Restitution, BlockOfNoneHardlyBounces) {
  edem::BodyDef def = block({4, 4, 4}, false, 0.1);
  def.material.springDamping = 0.03;
  def.material.contactDamping = 0.3;
  def.material.friction = 0.6;
  EXPECT_LT(bounce<TypeParam>(def, 0, 1), 0.05);
  // Without it half of the energy comes back from the block's own springs.
  EXPECT_GT(bounce<TypeParam>(def, 1, 1), 0.3);
}

TYPED_TEST(Restitution, BlockThatLandsOnItsEdgeHardlyBounces) {
  edem::BodyDef def = block({4, 4, 4}, false, 0.1);
  def.material.springDamping = 0.03;
  def.material.contactDamping = 0.3;
  def.material.friction = 0.6;
  // Landing, its centre is 0.26 high; it topples about the edge, over the half diagonal of 0.28 at most.
  EXPECT_LT(bounce<TypeParam>(def, 0, 1, 0.4), 0.05);
}

// Most that is missing of what gravity put into a packed cube, or too much, while it falls 1 m, lands on
// `ground` and rings, over what gravity put in.
template <class Real>
double notBooked(const edem::RigidProxy& ground, const Eigen::Quaterniond& turn) {
  edem::BodyDef def;
  def.asset = packedCube(216, 1);
  def.anchored = false;
  def.material.restitution = 0;
  const double half = 0.5 * kCubeEdge * turn.toRotationMatrix().row(1).cwiseAbs().sum();
  def.transform = Eigen::Translation3d(0, 1 + half, 0) * Eigen::Isometry3d(turn);
  const auto solver = makeSolver<Real>(false);
  solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {ground};
  proxies[0].key = 7;
  double worst = 0;
  for (int t = 0; t < 132; ++t) {  // it lands at 108
    solver->tick(1.0 / 240, kGravity, proxies);
    const edem::Books& b = solver->books();
    worst = std::max(worst, std::abs(b.kinetic + b.elastic - b.dissipated.done() - b.gravity.work.done()));
  }
  const edem::Books& b = solver->books();
  EXPECT_LT(b.kinetic, 0.5 * b.gravity.work.done()) << "it has not landed";
  return worst / b.gravity.work.done();
}

// A face that gives way is still pressed, and does not meet anew: that was wrong by 1.5e-2.
TYPED_TEST(Restitution, TheLandingOfABlockOfNoneIsBooked) {
  EXPECT_LT(notBooked<TypeParam>(fixedPlane(), Eigen::Quaterniond::Identity()), 1e-3);
}

// So is what a corner's spring holds as it slides from one cell into the next, under cells that have no face
// outside, and out of all: that was wrong by up to 4.8e-2.
TYPED_TEST(Restitution, LandingOnTheEdgesOfABoxIsBooked) {
  const auto over = [](double x, double z) { return fixedBox({0.5, 0.1, 0.5}, {x, -0.1, z}); };
  const Eigen::Quaterniond onEdge(Eigen::AngleAxisd(0.25 * std::numbers::pi, Eigen::Vector3d::UnitZ())),
      onCorner(Eigen::AngleAxisd(1, Eigen::Vector3d(35, 20, 40).normalized()));
  for (const Eigen::Quaterniond& turn : {Eigen::Quaterniond::Identity(), onEdge, onCorner}) {
    EXPECT_LT(notBooked<TypeParam>(over(0.53, 0), turn), 1e-3) << "over an edge of the box";
    EXPECT_LT(notBooked<TypeParam>(over(0.53, 0.53), turn), 1e-3) << "over a corner of it";
  }
}

// Most that a block of springs without dashpots, thrown onto a plane, has of the energy that it was thrown
// with.
template <class Real>
double mostEnergyOfAThrow(double restitution, const Eigen::Vector3d& spin) {
  edem::BodyDef def = block({3, 3, 3}, false, 0.1);
  def.material.springDamping = def.material.contactDamping = def.material.friction = 0;
  def.material.restitution = restitution;
  def.velocity = Eigen::Vector3d(0, -3, 0);
  def.spin = spin;
  def.transform = Eigen::Translation3d(0, 0.4, 0);
  const auto solver = makeSolver<Real>(false);
  solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {fixedPlane()};
  proxies[0].restitution = 1;
  double most = 0;
  for (int t = 0; t < 480; ++t) {
    solver->tick(1.0 / 480, kNoGravity, proxies);
    const edem::Books& b = solver->books();
    most = std::max(most, (b.kinetic + b.elastic) / b.initialEnergy);
  }
  EXPECT_EQ(solver->books().bullet.work.done(), 0);
  return most;
}

TYPED_TEST(Restitution, MakesNoEnergyOfABlocksOwnTrembling) {
  // The block turns as a whole while its corner still nears the plane, and back while the corner leaves it.
  for (const double e : {0.0, 0.5})
    for (const Eigen::Vector3d& spin :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(20, 0, 5), Eigen::Vector3d(-7, 3, 30)})
      EXPECT_LT(mostEnergyOfAThrow<TypeParam>(e, spin), 1 + 1e-3) << e << ", " << spin.transpose();
}

TEST(ContactYield, TheSpringHoldsWhatWasPutIntoIt) {
  // Any shares withheld on any way in: leapfrog's half forces put in what the spring then holds.
  constexpr double k = 3e6;
  double overlap = 0, work = 0;
  for (int step = 1; step <= 200; ++step) {
    const double way = 1e-5 * (1 + step % 7), withheld = 0.5 + 0.5 * std::sin(0.3 * step), start = overlap;
    const edem::ContactYield<double> yield(k, overlap + way, way, withheld);
    overlap += way - yield.yielded;
    EXPECT_GE(overlap, start);
    work += 0.5 * way * k * (1 - withheld) * (start + overlap);
    EXPECT_NEAR(work, 0.5 * k * overlap * overlap, 1e-9 * work);
    // What elastic forces do, less what is held.
    EXPECT_NEAR(yield.lost, 0.5 * way * k * (start + overlap) - 0.5 * k * (overlap * overlap - start * start),
                1e-9 * work);
  }
}

TEST(ContactYield, NothingGivesWayWhereNothingIsWithheldOrNears) {
  EXPECT_EQ(edem::ContactYield<double>(1e6, 1e-3, 1e-5, 0).yielded, 0);
  EXPECT_EQ(edem::ContactYield<double>(1e6, 1e-3, -1e-5, 1).yielded, 0);
  EXPECT_NEAR(edem::ContactYield<double>(1e6, 1e-3, 1e-5, 1).yielded, 1e-5, 1e-17) << "all of it";
}

TEST(Withheld, NothingIsWithheldWhileABlowComes) {
  EXPECT_EQ(edem::withheld(1, -3, 0, 0), 0);
  EXPECT_EQ(edem::withheld(1, 0, 0, 0), 0);
  EXPECT_EQ(edem::withheld(0.75, 3, 0.1, 0), 0.75);
  EXPECT_NEAR(edem::withheld(0.75, 0.05, 0, 0), 0.375, 1e-12);
  EXPECT_NEAR(edem::withheld(0.75, 0.5, 4, 0), 0.375, 1e-12) << "trembling of the contacts themselves";
  EXPECT_NEAR(edem::withheld(0.75, 0.1, 0, 0.4), 0.6, 1e-12) << "what rests stays";
  EXPECT_EQ(edem::withheld(0.75, 3, 0, 0.4), 0.75) << "at such a speed nothing rests";
}

TYPED_TEST(Restitution, LeavesTheBlowAsItIs) {
  // Up to the greatest depth the motion is the same, to the last bit.
  std::vector<double> depth[2];
  for (const int e : {0, 1}) {
    edem::BodyDef def = block({1, 1, 1});
    def.material.restitution = e;
    def.velocity = Eigen::Vector3d(0, -3, 0);
    const auto solver = makeSolver<TypeParam>(false);
    solver->addBody(def, kNoGravity);
    std::vector<edem::RigidProxy> proxies = {fixedPlane()};
    proxies[0].restitution = 1;
    while (solver->velocity(0, 0).y() < 0) {
      depth[e].push_back(solver->position(0, 0).y());
      solver->tick(1e-4, kNoGravity, proxies);
    }
  }
  EXPECT_EQ(depth[0], depth[1]);
  EXPECT_GT(depth[0].size(), 10u);
}

}  // namespace
}  // namespace rubble::test
