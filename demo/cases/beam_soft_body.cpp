#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "demo/cases/beam.h"
#include "demo/processor_time.h"

namespace rubble::demo::cantilever {
namespace {

constexpr double kCubeMass = kDensity * kCube * kCube * kCube;

// Corners of a cube, by bits of x, y, z; mirrored in every other cube so that their diagonals meet.
constexpr std::array<std::array<int, 4>, 5> kTetrahedra = {
    {{0, 3, 5, 6}, {0, 1, 3, 5}, {0, 3, 2, 6}, {0, 5, 4, 6}, {3, 5, 6, 7}}};

int nodeAt(int i, int j, int k) {
  return (i * (kAcross + 1) + j) * (kAcross + 1) + k;
}

std::vector<std::array<int, 4>> tetrahedra() {
  std::vector<std::array<int, 4>> all;
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j)
      for (int k = 0; k < kAcross; ++k)
        for (std::array<int, 4> corners : kTetrahedra) {
          for (int& corner : corners) {
            if ((i + j + k) % 2 != 0) corner ^= 1;
            corner = nodeAt(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2 & 1));
          }
          all.push_back(corners);
        }
  return all;
}

std::vector<btVector3> nodes() {
  std::vector<btVector3> places;
  for (int i = 0; i <= kAlong; ++i)
    for (int j = 0; j <= kAcross; ++j)
      for (int k = 0; k <= kAcross; ++k)
        places.emplace_back(btScalar(i * kCube), btScalar(j * kCube - kHeight / 2),
                            btScalar(k * kCube - kHeight / 2));
  return places;
}

// A node has the volume of the cubes around it; those at the root are held.
std::vector<btScalar> masses() {
  std::vector<btScalar> all;
  const auto share = [](int i, int count) { return i == 0 || i == count ? 0.5 : 1; };
  for (int i = 0; i <= kAlong; ++i)
    for (int j = 0; j <= kAcross; ++j)
      for (int k = 0; k <= kAcross; ++k)
        all.push_back(
            i == 0 ? 0 : btScalar(kCubeMass * share(i, kAlong) * share(j, kAcross) * share(k, kAcross)));
  return all;
}

std::unique_ptr<btSoftBody> makeBeam(btSoftBodyWorldInfo& info, int iterations, double linear) {
  const std::vector<btVector3> places = nodes();
  const std::vector<btScalar> mass = masses();
  auto beam = std::make_unique<btSoftBody>(&info, int(places.size()), places.data(), mass.data());
  std::set<std::pair<int, int>> edges;
  for (const std::array<int, 4>& t : tetrahedra()) {
    beam->appendTetra(t[0], t[1], t[2], t[3]);
    for (const int a : t)
      for (const int b : t)
        if (a < b) edges.insert({a, b});
  }
  beam->m_materials[0]->m_kLST = btScalar(linear);
  for (const auto& [a, b] : edges) beam->appendLink(a, b);
  beam->m_cfg.piterations = iterations;
  beam->setActivationState(DISABLE_DEACTIVATION);
  return beam;
}

}  // namespace

CaseOutcome runSoftBody(double rate, int iterations, double linear) {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.getWorldInfo().m_gravity = btVector3(0, btScalar(-kGravity), 0);
  world.getWorldInfo().air_density = 0;
  const std::unique_ptr<btSoftBody> beam = makeBeam(world.getWorldInfo(), iterations, linear);
  world.addSoftBody(beam.get(), 0, 0);

  const std::vector<btVector3> rest = nodes();
  SagError error;
  CaseOutcome outcome;
  for (int tick = 0; tick < int(std::lround(kSimulated * rate)); ++tick) {
    const double start = processorTime();
    world.stepSimulation(btScalar(1 / rate), 0);
    outcome.processorSeconds += processorTime() - start;
    outcome.simulatedSeconds += 1 / rate;
    if (tick < int(std::lround(kSettling * rate))) continue;
    for (int i = 0; i < beam->m_nodes.size(); ++i) {
      const btVector3& place = rest[std::size_t(i)];
      error.add(double(place.x()), double(place.y() - beam->m_nodes[i].m_x.y()));
    }
  }
  world.removeSoftBody(beam.get());
  outcome.error = error.value();
  return outcome;
}

}  // namespace rubble::demo::cantilever
