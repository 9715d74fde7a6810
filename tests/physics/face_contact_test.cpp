// Rigid bodies against the faces of the cells.
#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

constexpr double kEdge = 0.2;                           // of a cube of the block [m]
constexpr double kMass = 2400 * kEdge * kEdge * kEdge;  // [kg]
constexpr double kStiffness = 0.5 * 30e6 * kEdge;       // k_n of concrete_soft [N/m]
constexpr double kWeight = kMass * 9.81;                // [N]

edem::RigidProxy fixed(const edem::Collider& part, const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  edem::RigidProxy proxy;
  proxy.position = at;
  proxy.friction = 1;
  proxy.parts = {part};
  return proxy;
}

edem::Collider plane() {
  edem::Collider part;
  part.kind = edem::Collider::Kind::Plane;
  part.size = Eigen::Vector3d::UnitY();
  return part;
}

edem::Collider box(const Eigen::Vector3d& half) {
  edem::Collider part;
  part.kind = edem::Collider::Kind::Box;
  part.size = half;
  return part;
}

// A box as a hull.
edem::Collider hull(const Eigen::Vector3d& half) {
  auto hull = std::make_shared<edem::Hull>();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      edem::Hull::Face face;
      face.normal = side * Eigen::Vector3d::Unit(axis);
      face.offset = half[axis];
      constexpr std::array<std::array<double, 2>, 4> kRound{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
      for (unsigned c = 0; c < 4; ++c) {
        const auto& at = kRound[side > 0 ? c : 3 - c];
        Eigen::Vector3d v = half[axis] * face.normal;
        v[(axis + 1) % 3] = at[0] * half[(axis + 1) % 3];
        v[(axis + 2) % 3] = at[1] * half[(axis + 2) % 3];
        face.vertices.push_back(v);
      }
      hull->faces.push_back(face);
    }
  }
  edem::listCorners(*hull);
  edem::Collider part;
  part.kind = edem::Collider::Kind::Hull;
  part.hull = hull;
  return part;
}

edem::Collider round(edem::Collider::Kind kind) {
  edem::Collider part;
  part.kind = kind;
  part.size = {0.15, 0.3, 0.15};
  if (kind == edem::Collider::Kind::Cylinder || kind == edem::Collider::Kind::Cone) part.rounding = 0.01;
  return part;
}

edem::Collider sphere(double radius) {
  edem::Collider part;
  part.size.setConstant(radius);
  return part;
}

edem::BodyDef dampedBlock(const std::array<int, 3>& cubes) {
  edem::BodyDef def = block(cubes);
  def.material.springDamping = 0.1;
  def.material.contactDamping = 0.5;
  return def;
}

template <class Real>
class FaceContact : public ::testing::Test {
 protected:
  void run(double seconds, std::vector<edem::RigidProxy>& proxies, const Eigen::Vector3d& gravity) {
    for (int t = 0; t < int(seconds / kFrame + 0.5); ++t) {
      solver->tick(kFrame, gravity, proxies);
      ASSERT_EQ(solver->failure(), "");
      fastest = std::max(fastest, solver->maxSpeed(0));
    }
  }
  // Overlap at rest of a block of 2 x 2 x 2 on a surface whose top is at y = 0.
  double overlapOn(const edem::RigidProxy& ground) {
    solver = makeSolver<Real>(false);
    solver->addBody(dampedBlock({2, 2, 2}), kNoGravity);
    std::vector<edem::RigidProxy> proxies = {ground};
    run(2, proxies, kGravity);
    EXPECT_LT(solver->maxSpeed(0), 1e-3);
    return kEdge / 2 - solver->position(0, 0).y();
  }
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>(false);
  double fastest = 0;
};
TYPED_TEST_SUITE(FaceContact, Scalars);

TYPED_TEST(FaceContact, BlockRestsFlatOnEveryShape) {
  // Each lower element carries two: overlap = 2 m g / k_n. A hull's corners and a compound's seam do not add.
  const double overlap = 2 * kWeight / kStiffness;
  const Eigen::Vector3d half(1, 0.5, 1), below(0.2, -0.5, 0.2);
  EXPECT_NEAR(this->overlapOn(fixed(plane())), overlap, 0.02 * overlap) << "plane";
  EXPECT_NEAR(this->overlapOn(fixed(box(half), below)), overlap, 0.02 * overlap) << "box";
  EXPECT_NEAR(this->overlapOn(fixed(hull(half), below)), overlap, 0.02 * overlap) << "hull";
  // The seam lies under the middle of cubes.
  edem::RigidProxy compound = fixed(box(half), {0.3, -0.5, 0.2});
  compound.parts.push_back(hull(half));
  for (edem::Collider& part : compound.parts)
    part.place.translation().x() = &part == &compound.parts[0] ? -1 : 1;
  EXPECT_NEAR(this->overlapOn(compound), overlap, 0.02 * overlap) << "compound";
}

TYPED_TEST(FaceContact, ABallOnABlockIsCarriedAnywhere) {
  // On the middle of a cube, on a seam and on a crossing of seams its lowest point is at the top face, to the
  // overlap of a light body.
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(0.3, 0.3), Eigen::Vector2d(0.2, 0.3), Eigen::Vector2d(0.2, 0.2)}) {
    this->solver = makeSolver<TypeParam>(false);
    edem::BodyDef def = block({3, 1, 3}, true);
    def.material.contactDamping = 0.5;
    def.material.springDamping = 0.1;
    this->solver->addBody(def, kNoGravity);
    const double mass = 0.5, radius = 0.02;
    std::vector<edem::RigidProxy> proxies = {ball(radius, mass, {at.x(), kEdge + radius, at.y()}, {0, 0, 0})};
    proxies[0].acceleration = kGravity;
    this->run(1, proxies, kNoGravity);
    EXPECT_NEAR(proxies[0].position.y(), kEdge + radius, 1e-3 * radius) << at.transpose();
    EXPECT_LT(proxies[0].velocity.norm(), 1e-4);
  }
}

TYPED_TEST(FaceContact, ABallRollsOnABlockAsOnARigidRamp) {
  // A sphere that rolls: a = 5/7 g sin.
  constexpr double kAngle = 0.15, kTime = 0.5;
  edem::BodyDef def = block({8, 1, 3}, true);
  def.material.contactDamping = 0.3;
  def.material.springDamping = 0.1;
  def.material.friction = 0.6;
  this->solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {ball(0.05, 1, {0.13, kEdge + 0.05, 0.31}, {0, 0, 0})};
  proxies[0].friction = 1;
  proxies[0].acceleration = 9.81 * Eigen::Vector3d(std::sin(kAngle), -std::cos(kAngle), 0);
  this->run(kTime, proxies, kNoGravity);
  const double way = 0.5 * 5.0 / 7 * 9.81 * std::sin(kAngle) * kTime * kTime;
  EXPECT_NEAR(proxies[0].position.x() - 0.13, way, 0.02 * way);
  EXPECT_NEAR(proxies[0].position.z(), 0.31, 0.01 * way);
}

TYPED_TEST(FaceContact, ASmallBallIsStoppedWhereverItIsAimed) {
  for (int k = 0; k < 25; ++k) {
    this->solver = makeSolver<TypeParam>(false);
    edem::BodyDef def = block({4, 4, 1}, true, 0.05);
    def.material.contactDamping = 0.3;
    this->solver->addBody(def, kNoGravity);
    const double x = 0.05 + 0.02 * (k % 5), y = 0.1 + 0.02 * (k / 5);
    std::vector<edem::RigidProxy> proxies = {ball(0.005, 0.004, {x, y, 0.1}, {0, 0, -20})};
    this->run(0.1, proxies, kNoGravity);
    EXPECT_GT(proxies[0].position.z(), 0.05) << x << ", " << y;
    EXPECT_GT(proxies[0].velocity.z(), 0) << x << ", " << y;
  }
}

TYPED_TEST(FaceContact, ABouncingBlockKeepsItsEnergy) {
  // Flat, on an edge and on a corner, without damping or friction.
  for (const double turn : {0.0, 0.4, 0.7}) {
    this->solver = makeSolver<TypeParam>(false);
    edem::BodyDef def = block({2, 2, 2});
    def.material.restitution = 1;
    def.transform = Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 0, 0.5 + turn).normalized());
    def.transform.translation().y() = 0.3;
    def.velocity = Eigen::Vector3d(0, -3, 0);
    this->solver->addBody(def, kNoGravity);
    std::vector<edem::RigidProxy> proxies = {fixed(plane())};
    proxies[0].restitution = 1;
    this->run(0.5, proxies, kNoGravity);
    const edem::Books& b = this->solver->books();
    EXPECT_GT(b.bullet.linear.y(), 100) << "it has met the plane";
    EXPECT_NEAR(b.kinetic + b.elastic - b.dissipated.done(), b.initialEnergy, 1e-3 * b.initialEnergy) << turn;
  }
}

TYPED_TEST(FaceContact, ABlockBouncingOffARoundBodyKeepsItsEnergy) {
  // Without damping or friction, flat, on edges and corners of both. Deep in a body, where another of its
  // sides becomes the nearest, the force jumps within a step: 2 % holds for all.
  for (const auto kind :
       {edem::Collider::Kind::Capsule, edem::Collider::Kind::Cylinder, edem::Collider::Kind::Cone}) {
    for (const double turn : {0.0, 0.2, 0.7, 1.2, 1.5707963}) {
      this->solver = makeSolver<TypeParam>(false);
      edem::BodyDef def = block({2, 2, 2});
      def.material.restitution = 1;
      def.transform = Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 0.2, 0.5 + turn).normalized());
      def.transform.translation().y() = 0.8;
      def.velocity = Eigen::Vector3d(0, -3, 0);
      this->solver->addBody(def, kNoGravity);
      std::vector<edem::RigidProxy> proxies = {fixed(round(kind), {0.2, 0, 0.2})};
      proxies[0].friction = 0;
      proxies[0].restitution = 1;
      proxies[0].orientation = Eigen::AngleAxisd(1.3 * turn, Eigen::Vector3d(0.4, 0, 1).normalized());
      this->run(0.6, proxies, kNoGravity);
      const edem::Books& b = this->solver->books();
      EXPECT_GT(b.bullet.linear.y(), 100) << int(kind) << ": it has met it";
      EXPECT_NEAR(b.kinetic + b.elastic - b.dissipated.done(), b.initialEnergy, 0.02 * b.initialEnergy)
          << int(kind) << ", " << turn;
    }
  }
}

// Energy of an undamped blow at the end over that at the start, less 1: blocks at the edges and corners of a
// fixed box.
template <class Real>
double gainOfABlockAtABox(Numbers& numbers, double safety) {
  const auto solver = makeSolver<Real>(false, safety);
  edem::BodyDef def = block({2, 2, 2});
  const double speed = 4 + 3.5 * numbers.next();
  const Eigen::Vector3d axis = numbers.vector(1).normalized();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(3.1 * numbers.next(), axis));
  const double x = 1.1 * numbers.next(), z = 1.1 * numbers.next();
  def.transform = Eigen::Translation3d(x, 0.36, z) * turn * Eigen::Translation3d(-kEdge, -kEdge, -kEdge);
  def.velocity = speed * Eigen::Vector3d(0.5 * numbers.next(), -1, 0.5 * numbers.next());
  def.spin = numbers.vector(3);
  solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {fixedBox({1, 0.5, 1}, {0, -0.5, 0})};
  proxies[0].restitution = 1;
  for (int t = 0; t < 40; ++t) solver->tick(kFrame, kNoGravity, proxies);
  const edem::Books& b = solver->books();
  return (b.kinetic + b.elastic) / b.initialEnergy - 1;
}

// The same of boxes that tumble onto a slab, with corners and edges that slide over its cells.
template <class Real>
double gainOfABoxOnASlab(Numbers& numbers, double safety) {
  const auto solver = makeSolver<Real>(false, safety);
  solver->addBody(block({6, 1, 6}, true), kNoGravity);
  const double speed = 4 + 3.5 * numbers.next(), mass = 58;
  edem::RigidProxy thrown;
  thrown.parts = {box({0.15, 0.1, 0.2})};
  thrown.inverseMass = 1 / mass;
  thrown.inverseInertia = 3 / mass * Eigen::Vector3d(0.05, 0.0625, 0.0325).cwiseInverse();
  thrown.position = {0.6 + 0.3 * numbers.next(), 0.5, 0.6 + 0.3 * numbers.next()};
  const Eigen::Vector3d axis = numbers.vector(1).normalized();
  thrown.orientation = Eigen::AngleAxisd(3.1 * numbers.next(), axis);
  thrown.velocity = speed * Eigen::Vector3d(0.5 * numbers.next(), -1, 0.5 * numbers.next());
  thrown.spin = numbers.vector(5);
  thrown.friction = 0;
  thrown.restitution = 1;
  std::vector<edem::RigidProxy> proxies = {thrown};
  const auto kinetic = [&] {
    const edem::RigidProxy& p = proxies[0];
    const Eigen::Vector3d spin = p.orientation.conjugate() * p.spin;
    return 0.5 * (p.velocity.squaredNorm() / p.inverseMass +
                  (spin.array().square() / p.inverseInertia.array()).sum());
  };
  const double before = kinetic();
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kNoGravity, proxies);
  const edem::Books& b = solver->books();
  EXPECT_GT(b.bullet.linear.norm(), 10) << "it has met the slab";
  return (kinetic() + b.kinetic + b.elastic) / before - 1;
}

// Mean and largest size of some blows' gains.
template <class Gain>
std::pair<double, double> meanAndMost(int blows, Gain&& gain) {
  Numbers numbers;
  double sum = 0, most = 0;
  for (int blow = 0; blow < blows; ++blow) {
    const double size = std::abs(gain(numbers));
    sum += size;
    most = std::max(most, size);
  }
  return {sum / blows, most};
}

// Where a corner slides into the next cell and where another side of a box becomes the nearest, the energy
// goes on and only the force jumps: what is left is an error of the step, of its first order.
TYPED_TEST(FaceContact, EdgesAndCornersKeepTheirEnergyButForTheStep) {
#ifdef RUBBLE_SANITIZED  // the same code in every blow
  constexpr int kBlows = 4;
#else
  constexpr int kBlows = 40;
#endif
  const auto blocks = [](double safety) {
    return meanAndMost(kBlows, [=](Numbers& n) { return gainOfABlockAtABox<TypeParam>(n, safety); });
  };
  const auto boxes = [](double safety) {
    return meanAndMost(kBlows, [=](Numbers& n) { return gainOfABoxOnASlab<TypeParam>(n, safety); });
  };
  const auto [blockMean, blockMost] = blocks(0.9);
  const auto [boxMean, boxMost] = boxes(0.9);
  EXPECT_LT(blockMost, 0.05);
  EXPECT_LT(boxMost, 0.1);
  if (kBlows > 4) {  // four have no mean to speak of
    EXPECT_LT(blockMean, 0.01);
    EXPECT_LT(boxMean, 0.02);
    EXPECT_LT(blocks(0.3).first, 0.7 * blockMean);
    EXPECT_LT(boxes(0.3).first, 0.7 * boxMean);
  }
}

TYPED_TEST(FaceContact, FirstSeenDeepGivesNoKick) {
  const edem::Collider shapes[] = {plane(), box({1, 1, 1}), hull({1, 1, 1}), sphere(1)};
  for (const edem::Collider& part : shapes) {
    this->solver = makeSolver<TypeParam>(false);
    this->fastest = 0;
    this->solver->addBody(block({2, 2, 2}), kNoGravity);
    const bool isPlane = part.kind == edem::Collider::Kind::Plane;
    std::vector<edem::RigidProxy> proxies = {fixed(part, {0.2, isPlane ? 0.05 : -0.95, 0.2})};
    this->run(0.5, proxies, kNoGravity);
    EXPECT_LT(this->fastest, 0.01) << int(part.kind);
  }
}

TYPED_TEST(FaceContact, APackedCubeBearsOnAllItsSurface) {
  edem::BodyDef def;
  def.asset = packedCube(216, 1);
  def.anchored = false;
  def.material.springDamping = 0.2;
  def.material.contactDamping = 0.5;
  def.transform.translation().y() = kCubeEdge / 2;
  this->solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {fixed(plane())};
  this->run(0.5, proxies, kGravity);
  const Asset& asset = *def.asset;
  // Pressure rho g H on every outer face at the bottom: depth = p h / (E / 2), to the solid's own strain.
  const double depth = 2400 * 9.81 * kCubeEdge * asset.spacing() / (0.5 * 30e6);
  for (std::uint32_t i = 0; i < asset.elementCount(); ++i) {
    for (const CellFace& face : asset.cellFaces(i)) {
      if (face.neighbour != kNoElement || face.normal.y() > -0.9f) continue;
      const Eigen::Vector3d arm = face.centroid.cast<double>() - asset.positions[i];
      const double y = (this->solver->position(0, i) + this->solver->orientation(0, i) * arm).y();
      EXPECT_NEAR(-y, depth, 0.3 * depth) << "element " << i;
    }
  }
}

}  // namespace
}  // namespace rubble::test
