// Edges of boxes and hulls that lie across cells without a corner in them.
#include <algorithm>
#include <numbers>

#include "edem/edge_points.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

constexpr double kSlabCube = 0.2;                              // edge of the cubes of a slab [m]
constexpr double kCubeStiffness = 0.5 * 30e6 * kSlabCube;      // k_n of concrete_soft [N/m]
constexpr double kCubeWeight = 2400 * 0.2 * 0.2 * 0.2 * 9.81;  // [N]

edem::Collider sharpBox(const Eigen::Vector3d& half) {
  edem::Collider part;
  part.kind = edem::Collider::Kind::Box;
  part.size = half;
  return part;
}

// A box as a hull, each side as two triangles.
edem::Collider triangulatedBox(const Eigen::Vector3d& half) {
  auto hull = std::make_shared<edem::Hull>();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      std::vector<Eigen::Vector3d> round;
      for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        Eigen::Vector3d at = side * half[axis] * Eigen::Vector3d::Unit(axis);
        at[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        at[(axis + 2) % 3] = v * half[(axis + 2) % 3];
        round.push_back(at);
      }
      if (side < 0) std::reverse(round.begin(), round.end());
      for (const std::size_t second : {1u, 2u})
        hull->faces.push_back(
            {side * Eigen::Vector3d::Unit(axis), half[axis], {round[0], round[second], round[second + 1]}});
    }
  }
  edem::listCorners(*hull);
  hull->cornerWeight = 0.25;  // as four corners to a side have it
  edem::Collider part;
  part.kind = edem::Collider::Kind::Hull;
  part.hull = hull;
  return part;
}

edem::RigidProxy solidBox(const Eigen::Vector3d& half, double mass, const Eigen::Vector3d& at) {
  edem::RigidProxy proxy;
  proxy.parts = {sharpBox(half)};
  proxy.position = at;
  proxy.inverseMass = 1 / mass;
  const Eigen::Vector3d square = half.array().square();
  proxy.inverseInertia = 3 / mass * (Eigen::Vector3d::Constant(square.sum()) - square).cwiseInverse();
  proxy.acceleration = kGravity;
  return proxy;
}

edem::BodyDef dampedSlab(const std::array<int, 3>& cubes, bool anchored = true) {
  edem::BodyDef def = block(cubes, anchored);
  def.material.springDamping = 0.1;
  def.material.contactDamping = 0.5;
  def.material.friction = 1;
  return def;
}

double kineticOf(const edem::RigidProxy& p) {
  const Eigen::Vector3d spin = p.orientation.conjugate() * p.spin;
  return 0.5 * (p.velocity.squaredNorm() / p.inverseMass +
                (spin.array().square() / p.inverseInertia.array()).sum());
}

double tiltOf(const edem::RigidProxy& p) {
  return std::acos(std::min(1.0, (p.orientation * Eigen::Vector3d::UnitY()).y()));
}

template <class Real>
class EdgeContact : public ::testing::Test {
 protected:
  void run(double seconds, std::vector<edem::RigidProxy>& proxies,
           const Eigen::Vector3d& gravity = kNoGravity) {
    for (int t = 0; t < int(seconds / kFrame + 0.5); ++t) {
      solver->tick(kFrame, gravity, proxies);
      ASSERT_EQ(solver->failure(), "");
    }
  }
  // How deep a thing lies in a slab of 5 x 1 x 3 cubes at rest [m].
  double sinkOf(edem::RigidProxy thing) {
    const double height = thing.position.y();
    solver = makeSolver<Real>(false);
    solver->addBody(dampedSlab({5, 1, 3}), kNoGravity);
    std::vector<edem::RigidProxy> proxies = {thing};
    run(1.5, proxies);
    rested = proxies[0];
    EXPECT_LT(rested.velocity.norm(), 1e-4);
    return height - rested.position.y();
  }
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>(false);
  edem::RigidProxy rested;
};
TYPED_TEST_SUITE(EdgeContact, Scalars);

// Of steel, 40 x 40 mm, 1 m: it lies across three cubes, whose vertices are beside it, and overhangs by a
// cube on both sides.
edem::RigidProxy beamAt(double x) {
  return solidBox({0.02, 0.02, 0.5}, 7850 * 0.04 * 0.04, {x, kSlabCube + 0.02, 0.3});
}

TYPED_TEST(EdgeContact, ANarrowBeamLiesOnASlabThatItOverhangs) {
  // Two edges across three cubes: 3 k_n, by rows of points to a tenth. By the cores alone it sank by 50 mm.
  for (const double x : {0.5, 0.45, 0.53}) {
    edem::RigidProxy beam = beamAt(x);
    const double sink = 9.81 / beam.inverseMass / (3 * kCubeStiffness);
    const double measured = this->sinkOf(beam);
    EXPECT_NEAR(measured, 1.2 * sink, 0.2 * sink) << x;  // the beam is softened a little
    EXPECT_LT(tiltOf(this->rested), 1e-3) << x;
  }
}

TYPED_TEST(EdgeContact, FrictionHoldsABeamOnItsEdges) {
  for (const Eigen::Vector3d& aside : {Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(0, 0, 3)}) {
    edem::RigidProxy beam = beamAt(0.5);
    beam.friction = 0.5;
    beam.acceleration += aside;
    this->sinkOf(beam);
    const Eigen::Vector3d way = this->rested.position - beam.position;
    EXPECT_LT(std::hypot(way.x(), way.z()), 1e-4) << aside.transpose();
  }
}

TYPED_TEST(EdgeContact, AThinPlateStandsOnItsLongEdge) {
  // 10 mm thick, 0.2 m high, 1 m long; between the vertices of the cubes.
  edem::RigidProxy plate = solidBox({0.005, 0.1, 0.5}, 7850 * 0.01 * 0.2, {0.5, kSlabCube + 0.1, 0.3});
  const double sink = 7850 * 0.01 * 0.2 * 9.81 / (3 * kCubeStiffness);
  const double measured = this->sinkOf(plate);
  EXPECT_NEAR(measured, 1.2 * sink, 0.2 * sink);
  EXPECT_LT(tiltOf(this->rested), 1e-3);
}

TYPED_TEST(EdgeContact, ABlockLiesOnRailsAsOnAPlane) {
  // Two rails under the middles of 2 x 2 x 2 cubes: each lower cube lies on two edges, and carries two.
  this->solver = makeSolver<TypeParam>(false);
  this->solver->addBody(dampedSlab({2, 2, 2}, false), kNoGravity);
  std::vector<edem::RigidProxy> proxies;
  for (const double x : {0.1, 0.3}) {
    proxies.push_back(fixedBox({0.03, 0.1, 2}, {x, -0.1, 0.2}));
    proxies.back().friction = 1;
  }
  this->run(2, proxies, kGravity);
  const double overlap = 2 * kCubeWeight / kCubeStiffness;
  EXPECT_NEAR(kSlabCube / 2 - this->solver->position(0, 0).y(), overlap, 0.15 * overlap);
  EXPECT_LT(this->solver->maxSpeed(0), 1e-3);
}

// A lintel on a wall of one layer, as thick as it or nearly: the vertices of the wall are at the sides of the
// lintel, and its edges at those of the wall. It lies on three faces of k_n; it sank to the cores, by 50 mm.
TYPED_TEST(EdgeContact, WhatIsAsWideAsTheCellsLiesOnThem) {
  constexpr double kLintelMass = 400;
  const double sink = kLintelMass * 9.81 / (3 * kCubeStiffness);
  for (const bool isHull : {false, true}) {
    for (const double wider : {-0.01, -1e-4, 0.0, 1e-9, 1e-4, 0.005, 0.02}) {
      for (const double aside : {0.0, 0.003}) {
        this->solver = makeSolver<TypeParam>(false);
        this->solver->addBody(dampedSlab({3, 1, 1}), kNoGravity);
        const Eigen::Vector3d half(0.4, 0.1, kSlabCube / 2 + wider);
        edem::RigidProxy lintel = solidBox(half, kLintelMass, {0.3, kSlabCube + 0.1, kSlabCube / 2 + aside});
        if (isHull) lintel.parts = {triangulatedBox(half)};
        std::vector<edem::RigidProxy> proxies = {lintel};
        this->run(1.5, proxies);
        const double measured = lintel.position.y() - proxies[0].position.y();
        const char* kind = isHull ? "hull" : "box";
        // Both edges and, where they are a little inside the lintel, the vertices.
        EXPECT_GT(measured, 0.4 * sink) << kind << ", wider by " << wider << ", aside by " << aside;
        EXPECT_LT(measured, 2 * sink) << kind << ", wider by " << wider << ", aside by " << aside;
        EXPECT_LT(tiltOf(proxies[0]), 2e-3) << kind << ", wider by " << wider << ", aside by " << aside;
        EXPECT_LT(proxies[0].velocity.norm(), 1e-3);  // it still sways
      }
    }
  }
}

TYPED_TEST(EdgeContact, AHullThatIsABoxLiesAsTheBox) {
  edem::RigidProxy beam = beamAt(0.47);
  beam.orientation = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
  const double sink = this->sinkOf(beam);
  const edem::RigidProxy box = this->rested;
  beam.parts = {triangulatedBox({0.02, 0.02, 0.5})};
  EXPECT_NEAR(this->sinkOf(beam), sink, 0.01 * sink);
  EXPECT_LT((this->rested.position - box.position).norm(), 0.02 * sink);
}

TYPED_TEST(EdgeContact, ALightBeamComesToRest) {
  // A hundredth of a cube's mass: it would need a shorter step than the cubes do.
  edem::RigidProxy beam = beamAt(0.5);
  beam = solidBox({0.02, 0.02, 0.5}, 0.2, beam.position + Eigen::Vector3d(0, 0.05, 0));
  beam.spin = {0.3, 0, 0.2};
  const double sink = this->sinkOf(beam) - 0.05;
  EXPECT_LT(std::abs(sink), 1e-4);
}

TYPED_TEST(EdgeContact, ABeamSlidesAlongItselfWithoutABump) {
  // Without friction its points pass from cube to cube and over the rims of the slab.
  edem::RigidProxy beam = beamAt(0.5);
  beam.velocity = {0, 0, 0.4};
  beam.friction = 0;
  this->solver = makeSolver<TypeParam>(false);
  this->solver->addBody(dampedSlab({5, 1, 3}), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {beam};
  this->run(0.5, proxies);
  EXPECT_NEAR(proxies[0].velocity.z(), 0.4, 4e-4);
}

// Energy of an undamped blow of a box with its edge, at the end over that at the start, less 1.
template <class Real>
double gainEdgeFirst(Numbers& numbers, double safety, const Eigen::Vector3d& half) {
  const auto solver = makeSolver<Real>(false, safety);
  solver->addBody(block({6, 1, 6}, true), kNoGravity);
  edem::RigidProxy thrown = solidBox(half, 58, {0.6 + 0.1 * numbers.next(), 0.5, 0.6 + 0.1 * numbers.next()});
  thrown.acceleration.setZero();
  const double yaw = 3.1 * numbers.next(), roll = std::numbers::pi / 4 + 0.3 * numbers.next();
  thrown.orientation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
                       Eigen::AngleAxisd(0.02 * numbers.next(), Eigen::Vector3d::UnitX()) *
                       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
  thrown.velocity = Eigen::Vector3d(0.5 * numbers.next(), -4 - 3 * numbers.next(), 0.5 * numbers.next());
  thrown.friction = 0;
  thrown.restitution = 1;
  std::vector<edem::RigidProxy> proxies = {thrown};
  const double before = kineticOf(thrown);
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kNoGravity, proxies);
  const edem::Books& b = solver->books();
  EXPECT_GT(b.bullet.linear.norm(), 10) << "it has met the slab";
  return (kineticOf(proxies[0]) + b.kinetic + b.elastic) / before - 1;
}

TYPED_TEST(EdgeContact, ABlowWithAnEdgeKeepsItsEnergyButForTheStep) {
  for (const double length : {0.2, 0.9}) {  // within the slab, and over its rims
    for (const double safety : {0.9, 0.3}) {
      Numbers numbers;
      double sum = 0, most = 0;
      constexpr int kBlows = 20;
      for (int blow = 0; blow < kBlows; ++blow) {
        const double gain = std::abs(gainEdgeFirst<TypeParam>(numbers, safety, {0.12, 0.1, length}));
        sum += gain / kBlows;
        most = std::max(most, gain);
      }
      EXPECT_LT(sum, safety < 0.5 ? 0.004 : 0.006) << length;  // 0.0038, 0.0016 with a third of the step
      EXPECT_LT(most, 0.04) << length;
    }
  }
}

}  // namespace

TEST(EdgeRow, HasThePointsWithinReachAndNoOthers) {
  Numbers numbers;
  for (int n = 0; n < 200; ++n) {
    const Eigen::Vector3d from = numbers.vector(1), way = numbers.vector(2), at = numbers.vector(1.5);
    const double h = 0.3 + 0.2 * numbers.next(), reach = 0.5 + 0.4 * numbers.next();
    const edem::EdgeRow row(from, way, 1, h);
    const edem::EdgeRow::Range range = row.within(at, reach);
    ASSERT_LE(range.first, range.last);
    if (2 * way.norm() <= h) {
      EXPECT_EQ(range.count(), 0u);
      continue;
    }
    // By halving until points are h / 2 apart.
    std::uint32_t count = 1;
    while (way.norm() / count > h / 2) count *= 2;
    EXPECT_NEAR(row.weight() * 2 * h, way.norm() / count, 1e-12);
    for (std::uint32_t p = 1; p < count; ++p) {
      const Eigen::Vector3d point = from + way * p / count;
      EXPECT_LT((row.at(p) - point).norm(), 1e-12);
      EXPECT_EQ(range.first <= p && p < range.last, (point - at).norm() < reach) << n;
    }
  }
}

TEST(EdgeRow, NamesAPlaceTheSameAtEverySpacing) {
  const Eigen::Vector3d from(0, 0, 0), way(0, 0, 3);
  const edem::EdgeRow coarse(from, way, 1, 1), fine(from, way, 1, 0.25);
  EXPECT_EQ(coarse.nameOf(1), fine.nameOf(4));
  EXPECT_EQ(coarse.at(1), fine.at(4));
  EXPECT_NE(coarse.nameOf(1), fine.nameOf(1));
}

TEST(EdgeRow, VisitsNoMoreOfALongEdge) {
  const edem::EdgeRow row({0, 0, -5000}, {0, 0, 10000}, 1, 0.2);
  EXPECT_LE(row.within({0.05, 0.05, 3}, 0.2).count(), 8u);
  EXPECT_GE(row.within({0.05, 0.05, 3}, 0.2).count(), 3u);
}

TEST(EdgeRow, TrianglesOfOneSideShareNoEdge) {
  const edem::Collider part = triangulatedBox({1, 2, 3});
  EXPECT_EQ(part.hull->edges.size(), 12u);
  double length = 0;
  for (const edem::Hull::Edge& e : part.hull->edges) {
    EXPECT_NEAR(e.sharpness, 1, 1e-12);
    length += e.way.norm();
  }
  EXPECT_NEAR(length, 4 * (2 + 4 + 6), 1e-12);
}

}  // namespace rubble::test
