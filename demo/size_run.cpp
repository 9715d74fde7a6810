#include "demo/size_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "demo/console.h"
#include "demo/exit_speed.h"
#include "demo/processor_time.h"
#include "demo/world.h"

namespace rubble::demo {
namespace {

constexpr int kSizedFrames = 18;  // the ball has left the wall in the twelfth

// Faces and energies of the springs that broke.
struct Cracks {
  double area = 0, tensionArea = 0, tensionEnergy = 0;  // [m^2], [m^2], [J]

  void add(const Asset& asset, const SpringBroken& event) {
    if (event.mode == BreakMode::Crushed) return;
    const std::size_t springs = asset.springs.size();
    const double face = event.spring < springs ? asset.springs[event.spring].area
                                               : asset.anchors[event.spring - springs].area;
    area += face;
    if (event.mode != BreakMode::Tension) return;
    tensionArea += face;
    tensionEnergy += double(event.energy);
  }
};

void countFragments(SizeRun& run, const DestructibleBody& body) {
  std::map<std::uint32_t, double> masses;  // by root [kg]
  double whole = 0, largest = 0;
  for (std::size_t i = 0; i < body.asset()->elementCount(); ++i) {
    const double mass = body.material().density * body.asset()->volumes[i];
    whole += mass;
    if (body.elementsAlive()[i]) masses[body.fragments()[i]] += mass;
  }
  for (const auto& [root, mass] : masses) {
    largest = std::max(largest, mass);
    run.light += mass > kLightFragment ? 1 : 0;
    run.heavy += mass > kHeavyFragment ? 1 : 0;
  }
  run.largest = largest / whole;
  run.mass = whole;
}

}  // namespace

Scene sizedWall(std::uint32_t elements, std::uint64_t seed) {
  // Of spheres that fill the same share of the wall, or they would not be that many.
  Scene scene = loadScene("wall", {{"objects.0.elements", std::to_string(elements), kSizeReportName},
                                   {"objects.0.radius", "0", kSizeReportName},
                                   {"seed", std::to_string(seed), kSizeReportName},
                                   {"frames", std::to_string(kSizedFrames), kSizeReportName}});
  scene.dust.reset();  // it does not act back on the mechanics
  return scene;
}

SizeRun runSized(std::uint32_t elements, std::uint64_t seed, const std::function<void(double)>& shown) {
  const Scene scene = sizedWall(elements, seed);
  World world(scene, cookObjects(scene), consoleLog());
  const DestructibleBody& wall = *world.destruction().bodies().front();
  const Asset& asset = *wall.asset();
  ExitSpeed exitSpeed(world);
  Cracks cracks;
  double seconds = 0;
  for (int frame = 0; frame < scene.frames; ++frame) {
    const double start = processorTime();
    world.step();
    seconds += processorTime() - start;
    for (const SpringBroken& event : world.destruction().takeEvents().springsBroken) cracks.add(asset, event);
    exitSpeed.update(world);
    if (shown) shown((frame + 1.0) / scene.frames);
  }
  SizeRun run{.wanted = elements, .elements = std::uint32_t(asset.elementCount()), .seed = seed};
  double volume = 0;
  for (const double v : asset.volumes) volume += v;
  const Material& material = wall.material();
  run.spacing = std::cbrt(volume / run.elements);
  run.crackArea = cracks.area;
  run.tensionEnergy = cracks.tensionArea > 0 ? cracks.tensionEnergy / cracks.tensionArea : 0;
  run.asked = tensionEnergyPerArea(material.tensileStrength, material.youngsModulus, run.spacing);
  const Ledger& ledger = world.destruction().ledger();
  run.dust = ledger.massDustEmitted;
  run.crushed = ledger.massDebris + ledger.massRemoved + ledger.massDustEmitted;
  run.strikingSpeed = scene.impactors.front().velocity.norm();
  run.exitSpeed = exitSpeed.value().value_or(0);
  run.milliseconds = 1e3 * seconds / (scene.frames / scene.fps);
  countFragments(run, wall);
  return run;
}

}  // namespace rubble::demo
