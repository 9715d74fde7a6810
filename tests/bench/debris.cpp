// Debris: pieces that fly, slide and rest, in a step each; and what is done once.
#include <benchmark/benchmark.h>

#include <vector>

#include "base/hash.h"
#include "bench/topic.h"
#include "debris/debris_system.h"
#include "rubble/material.h"
#include "unit/debris/cells.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
using namespace debris;
namespace {

constexpr std::uint32_t kPieces = 100000;  // the default budget
constexpr std::uint32_t kAside = 400;      // pieces along x
constexpr double kBetween = 0.1;           // from piece to piece [m]
constexpr int kFaces = 14;                 // of a usual cell

Surroundings ground() {
  return Surroundings({TestPlane{}});
}

// All pieces side by side at one height, at one velocity.
std::vector<DebrisParcel> sheet(std::uint32_t count, double height, const Eigen::Vector3d& velocity,
                                double friction) {
  std::vector<DebrisParcel> parcels;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d place(kBetween * (i % kAside), height, kBetween * (i / kAside));
    parcels.push_back(stone(place, velocity));
    parcels.back().friction = friction;
    parcels.back().element = i;
  }
  return parcels;
}

void stepAll(benchmark::State& state, DebrisSystem& system, Surroundings& surroundings) {
  for (auto _ : state) {
    static_cast<void>(_);
    system.step(kTick, kDown, surroundings);
  }
  state.SetItemsProcessed(state.iterations() * system.movingCount());
}

void fly(benchmark::State& state) {
  constexpr double kHigh = 5000;  // no ground within reach [m]
  DebrisSystem system(DebrisSystemDef{});
  system.add(sheet(kPieces, kHigh, Eigen::Vector3d(5, 5, 0), 0));
  Surroundings sky;
  stepAll(state, system, sky);
}

// Without friction and air it never ends.
void slide(benchmark::State& state) {
  DebrisSystemDef def;
  def.air = kVacuum;
  DebrisSystem system(def);
  system.add(sheet(kPieces, stone(0).radius, Eigen::Vector3d::UnitX(), 0));
  Surroundings floor = ground();
  stepAll(state, system, floor);
  if (system.movingCount() != kPieces) state.SkipWithError("pieces do not slide on");
}

DebrisSystem atRest() {
  DebrisSystemDef def;
  def.restTime = 0;  // at once
  DebrisSystem system(def);
  system.add(sheet(kPieces, stone(0).radius, Eigen::Vector3d::Zero(), 0.6));
  Surroundings floor = ground();
  while (system.movingCount() > 0) system.step(kTick, kDown, floor);
  return system;
}

void rest(benchmark::State& state) {
  DebrisSystem system = atRest();
  Surroundings floor = ground();
  stepAll(state, system, floor);
}

// `place` of a box that holds no piece, so that all rest on.
void wakeAt(benchmark::State& state, const Eigen::Vector3d& place) {
  DebrisSystem system = atRest();
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(kBetween / 4);
  const Eigen::AlignedBox3d box(place - half, place + half);
  std::uint32_t woken = 0;
  for (auto _ : state) {
    static_cast<void>(_);
    woken += system.wake({&box, 1});
  }
  if (woken > 0) state.SkipWithError("pieces woke");
}

void hashAll(benchmark::State& state) {
  const DebrisSystem system = atRest();
  for (auto _ : state) {
    static_cast<void>(_);
    benchmark::DoNotOptimize(system.hash());
  }
  state.SetItemsProcessed(state.iterations() * kPieces);
}

void spawn(benchmark::State& state) {
  Random random(1);
  TestCell cell = randomCell(random, kFaces);
  setInMotion(random, cell.element);
  cell.element.maxRadius = cell.element.radius / 2;  // no piece is dust
  Spawner spawner(Material{}, Model{}, 1);
  DebrisBatch batch;
  spawner.reserve(kFaces, batch);
  for (auto _ : state) {
    static_cast<void>(_);
    ++cell.element.element;
    spawner.spawn(cell.element, cell.faces, batch);
  }
  state.SetItemsProcessed(state.iterations() * kFaces);
}

void add() {
  const auto named = [](const char* name, auto body) {
    benchmark::RegisterBenchmark(name, body)->Unit(benchmark::kMicrosecond);
  };
  const Eigen::Vector3d between(kBetween / 2, 0, kBetween / 2), away(0, 10, 0);
  named("debris/a step, all fly", fly);
  named("debris/a step, all slide", slide);
  named("debris/a step, all rest", rest);
  named("debris/`wake`, box among them", [between](benchmark::State& state) { wakeAt(state, between); });
  named("debris/`wake`, box away from them", [away](benchmark::State& state) { wakeAt(state, away); });
  named("debris/`hash`", hashAll);
  named("debris/`spawn` of a cell of 14 faces", spawn);
}

// A few cells become pieces that fall, slide and come to rest.
std::uint64_t smallResult() {
  Random random(1);
  Spawner spawner(Material{}, Model{}, 1);
  DebrisSystem system(DebrisSystemDef{});
  DebrisBatch batch;
  for (int i = 0; i < 4; ++i) {
    TestCell cell = randomCell(random, kFaces);
    setInMotion(random, cell.element);
    cell.element.centre.y() += 1.5;
    spawner.spawn(cell.element, cell.faces, batch);
    system.add(batch.pieces);
  }
  Surroundings floor = ground();
  for (int i = 0; i < 480; ++i) system.step(kTick, kDown, floor);
  return system.hash();
}

std::uint64_t hash() {
  base::Fnv1a sum;
  for (const std::uint32_t count : {kPieces, kAside, std::uint32_t(kFaces)}) sum.add(count);
  for (const double number : {kBetween, kTick, kDown.y()}) sum.add(number);
  sum.add(smallResult());
  return sum.value();
}

}  // namespace

BenchTopic debrisTopic() {
  using Kind = BenchColumn::Kind;
  return {"debris", {{"time", Kind::Time, ""}, {"a piece", Kind::ItemTime, ""}}, false, add, hash};
}

}  // namespace rubble::test
