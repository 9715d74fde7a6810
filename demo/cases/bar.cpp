#include "demo/cases/bar.h"

namespace rubble::demo::bar {
namespace {

constexpr int kBoxes = 20, kOuterBoxes = 2;
constexpr double kBox = kLength / kBoxes;

double restDepth(int box) {
  return kBox * (box + 0.5);
}

}  // namespace

DestructibleBodyDef elements(std::size_t count) {
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox({kWidth, kLength, kWidth}, count, Eigen::Vector3d::UnitY());
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  return def;
}

Outer outerOf(const DestructibleBody& body) {
  Outer outer{0, 0};
  int count = 0;
  const std::vector<Eigen::Vector3d> places = placesOf(body);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double rest = body.asset()->positions[i].y(), depth = kLength / 2 - rest;
    if (depth < kOuter) continue;
    outer.depth += depth;
    outer.sink += rest - places[i].y();
    ++count;
  }
  return {outer.depth / count, outer.sink / count};
}

Chain::Chain(CaseWorld& world, int iterations, double damping) {
  world.world().getSolverInfo().m_numIterations = iterations;
  const auto shape = [] {
    return std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d(kWidth, kBox, kWidth) / 2));
  };
  btRigidBody* above = &world.add(0, shape(), {0, kBox / 2, 0}, false);
  btTransform lower = btTransform::getIdentity(), upper = btTransform::getIdentity();
  lower.setOrigin(toBullet({0, -kBox / 2, 0}));
  upper.setOrigin(toBullet({0, kBox / 2, 0}));
  for (int i = 0; i < kBoxes; ++i) {
    btRigidBody* box = &world.add(kDensity * kBox * kWidth * kWidth, shape(), {0, -restDepth(i), 0}, false);
    auto joint = std::make_unique<btGeneric6DofSpring2Constraint>(*above, *box, lower, upper);
    joint->setLimit(1, 1, 0);  // lower above upper: free along y
    for (const int locked : {0, 2, 3, 4, 5}) joint->setLimit(locked, 0, 0);
    joint->enableSpring(1, true);
    const double reach = i == 0 ? kBox / 2 : kBox;  // from the fixed end, or from centre to centre
    joint->setStiffness(1, btScalar(kModulus * kWidth * kWidth / reach));
    joint->setDamping(1, 0);
    joint->setEquilibriumPoint(1, 0);
    world.join(std::move(joint));
    box->setDamping(btScalar(damping), btScalar(damping));
    m_boxes.push_back(box);
    above = box;
  }
}

Outer Chain::outer() const {
  Outer outer{0, 0};
  for (int i = kBoxes - kOuterBoxes; i < kBoxes; ++i) {
    const double y = double(m_boxes[std::size_t(i)]->getWorldTransform().getOrigin().y());
    outer.depth += restDepth(i) / kOuterBoxes;
    outer.sink += (-y - restDepth(i)) / kOuterBoxes;
  }
  return outer;
}

}  // namespace rubble::demo::bar
