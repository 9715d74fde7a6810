// What bodies that nothing strikes cost beside rigid bodies of Bullet's of the same shape, in the same run.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "base/hash.h"
#include "bench/processor_time.h"
#include "bench/topic.h"
#include "demo/stability/bullet_world.h"
#include "rubble/destructible_body.h"
#include "rubble/version.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr int kRow = 32;            // blocks along x, a metre apart
constexpr int kCubes = 4;           // along an edge of a block
constexpr double kEdge = 0.05;      // of a cube [m]
constexpr double kStep = 1.0 / 60;  // [s]
constexpr int kTicksToRest = 300;   // Bullet's two seconds, and the landing
constexpr int kCounts[] = {1, 100, 1000};

// Blocks that lie apart on the ground; whole ones, or boxes of Bullet's alone.
class Blocks {
 public:
  Blocks(int count, bool whole, bool awake) {
    m_world.world.setGravity({0, btScalar(-9.81), 0});
    if (whole) m_world.destruction = std::make_unique<Destruction>(m_world.world);
    DestructibleBodyDef def;
    def.asset = std::make_shared<const Asset>(
        gridAsset({.cubes = {kCubes, kCubes, kCubes}, .edge = kEdge, .anchored = false}));
    def.material = material("concrete_soft");
    def.regime = Regime::RigidUntilStruck;
    const double mass = def.material.density * def.asset->volume();
    for (int i = 0; i < count; ++i) {
      const btVector3 corner(btScalar(i % kRow), 0, btScalar(i / kRow));
      btRigidBody* body = nullptr;
      if (whole) {
        def.transform.setOrigin(corner);
        body = m_world.destruction->addBody(def);
      } else {
        body = m_world.add(btScalar(mass), m_box, corner + m_box.getHalfExtentsWithMargin());
        body->setFriction(btScalar(def.material.friction));
        body->setRestitution(btScalar(def.material.restitution));
      }
      if (awake) body->setActivationState(DISABLE_DEACTIVATION);
      m_bodies.push_back(body);
    }
    for (int t = 0; t < kTicksToRest; ++t) step();
  }
  ~Blocks() { m_world.clear(); }

  void step() { m_world.world.stepSimulation(btScalar(kStep), 1, btScalar(kStep)); }
  bool areAll(bool awake) const {
    for (const btRigidBody* body : m_bodies) {
      const DestructibleBody* block = DestructibleBody::upcast(body);
      if (body->isActive() != awake || (block && !block->isWhole())) return false;
    }
    return true;
  }

 private:
  stability::BulletWorld m_world;
  btBoxShape m_box{btVector3(1, 1, 1) * btScalar(kCubes * kEdge / 2)};
  std::vector<btRigidBody*> m_bodies;
};

// By turns, so that what the machine does beside tells on both.
void compare(benchmark::State& state, int count, bool awake) {
  Blocks whole(count, true, awake), stock(count, false, awake);
  if (!whole.areAll(awake) || !stock.areAll(awake)) return state.SkipWithError("not as they should be");
  double wholeTime = 0, stockTime = 0;
  for (auto _ : state) {
    static_cast<void>(_);
    {
      const ScopeProcessorTime time(wholeTime);
      whole.step();
    }
    const ScopeProcessorTime time(stockTime);
    stock.step();
  }
  const double ticks = double(state.iterations());
  state.counters["whole"] = wholeTime / ticks;
  state.counters["stock"] = stockTime / ticks;
  state.counters["ratio"] = wholeTime / stockTime;
}

void add() {
  for (const bool awake : {true, false})
    for (const int count : kCounts)
      benchmark::RegisterBenchmark(
          ("whole_bodies/" + std::to_string(count) + (awake ? ", awake" : ", asleep")).c_str(),
          [=](benchmark::State& state) { compare(state, count, awake); })
          ->Unit(benchmark::kMicrosecond);
}

std::uint64_t hash() {
  base::Fnv1a sum;
  for (const int count : kCounts) sum.add(std::uint32_t(count));
  for (const int number : {kRow, kCubes, kTicksToRest}) sum.add(std::uint32_t(number));
  for (const double number : {kEdge, kStep}) sum.add(number);
  for (const SolverVersion& version : kSolverVersions) sum.add(version.world);
  return sum.value();
}

}  // namespace

BenchTopic wholeBodiesTopic() {
  using Kind = BenchColumn::Kind;
  return {"whole_bodies",
          {{"a tick", Kind::Seconds, "whole"},
           {"of rigid bodies", Kind::Seconds, "stock"},
           {"ratio", Kind::Counter, "ratio"}},
          false,
          add,
          hash};
}

}  // namespace rubble::test
