#include <cmath>

#include "demo/cases/beam.h"
#include "demo/cases/case_world.h"

namespace rubble::demo::cantilever {
namespace {

class Lattice {
 public:
  explicit Lattice(CaseWorld& world);
  void addSags(SagError& error) const;

 private:
  static std::size_t indexOf(int i, int j, int k) { return std::size_t((i * kAcross + j) * kAcross + k); }
  static Eigen::Vector3d restOf(int i, int j, int k) {
    return kCube * Eigen::Vector3d(i + 0.5, j + 0.5 - kAcross / 2.0, k + 0.5 - kAcross / 2.0);
  }
  void join(CaseWorld& world, btRigidBody& a, btRigidBody& b, int axis, double reach);

  std::vector<btRigidBody*> m_cubes;
};

Lattice::Lattice(CaseWorld& world) {
  const auto shape = [](double edge) {
    return std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d::Constant(edge / 2)));
  };
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j)
      for (int k = 0; k < kAcross; ++k)
        m_cubes.push_back(&world.add(kDensity * std::pow(kCube, 3), shape(kCube), restOf(i, j, k), false));
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j)
      for (int k = 0; k < kAcross; ++k) {
        btRigidBody& cube = *m_cubes[indexOf(i, j, k)];
        if (i == 0) join(world, world.add(0, shape(kCube), restOf(-1, j, k), false), cube, 0, kCube / 2);
        if (i > 0) join(world, *m_cubes[indexOf(i - 1, j, k)], cube, 0, kCube);
        if (j > 0) join(world, *m_cubes[indexOf(i, j - 1, k)], cube, 1, kCube);
        if (k > 0) join(world, *m_cubes[indexOf(i, j, k - 1)], cube, 2, kCube);
      }
}

// At the face between them: E A / h along its normal and half of that across, for a Poisson's ratio of 0;
// about it E I / h, about the normal G J / h.
void Lattice::join(CaseWorld& world, btRigidBody& a, btRigidBody& b, int axis, double reach) {
  btTransform onA = btTransform::getIdentity(), onB = btTransform::getIdentity();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  half[axis] = kCube / 2;
  onA.setOrigin(toBullet(half));
  onB.setOrigin(toBullet(-half));
  auto joint = std::make_unique<btGeneric6DofSpring2Constraint>(a, b, onA, onB);
  const double area = kCube * kCube, second = area * area / 12;
  for (int d = 0; d < 3; ++d) {
    const double along = d == axis ? kModulus : kModulus / 2;
    const double about = d == axis ? kModulus / 2 * 2 * second : kModulus * second;
    for (const auto& [index, stiffness] : {std::pair(d, along * area / reach), {d + 3, about / reach}}) {
      joint->setLimit(index, 1, 0);  // lower above upper: free
      joint->enableSpring(index, true);
      joint->setStiffness(index, btScalar(stiffness));
      joint->setDamping(index, 0);
      joint->setEquilibriumPoint(index, 0);
    }
  }
  world.join(std::move(joint));
}

void Lattice::addSags(SagError& error) const {
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j)
      for (int k = 0; k < kAcross; ++k) {
        const Eigen::Vector3d rest = restOf(i, j, k);
        const btRigidBody& cube = *m_cubes[indexOf(i, j, k)];
        error.add(rest.x(), rest.y() - double(cube.getWorldTransform().getOrigin().y()));
      }
}

}  // namespace

CaseOutcome runLattice(double rate, int iterations) {
  CaseWorld world(kGravity);
  world.world().getSolverInfo().m_numIterations = iterations;
  const Lattice lattice(world);
  SagError error;
  for (int tick = 0; tick < int(std::lround(kSimulated * rate)); ++tick) {
    world.step(1 / rate);
    if (tick >= int(std::lround(kSettling * rate))) lattice.addSags(error);
  }
  return world.outcome(error.value());
}

}  // namespace rubble::demo::cantilever
