// A block slides over level ground until friction has stopped it.
#include <cmath>

#include "demo/cases/block_on_ground.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace slide {
namespace {

constexpr double kSpeed = 2, kSimulated = 1.2;  // [m/s], [s]; it takes 0.68 s to stop

double errorOf(double way) {
  return std::abs(way / stopDistance(kSpeed, block::kFriction, block::kGravity) - 1);
}

CaseOutcome runElements(Precision precision, double substepSafety) {
  constexpr double kTick = 1.0 / 240;  // [s]
  CaseWorld world(block::kGravity);
  const DestructibleBody* block = block::add(world, precision, substepSafety, {kSpeed, 0, 0});
  for (int tick = 0; tick < int(std::lround(kSimulated / kTick)); ++tick) world.step(kTick);
  const std::vector<Eigen::Vector3d> places = placesOf(*block);
  double way = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    way += (places[i] - block->asset()->positions[i]).x() / double(places.size());
  return world.outcome(errorOf(way));
}

CaseOutcome runStock(double rate) {
  CaseWorld world(block::kGravity);
  btRigidBody& block = block::addStock(world);
  block.setLinearVelocity(toBullet({kSpeed, 0, 0}));
  for (int tick = 0; tick < int(std::lround(kSimulated * rate)); ++tick) world.step(1 / rate);
  return world.outcome(errorOf(double(block.getWorldTransform().getOrigin().x())));
}

}  // namespace
}  // namespace slide

double stopDistance(double speed, double friction, double gravity) {
  return speed * speed / (2 * friction * gravity);
}

ReportCase slideCase() {
  using namespace slide;
  ReportCase c{
      .name = "slide",
      .what =
          "A block of 0.4 x 0.1 x 0.4 m, 32 elements, 2400 kg/m3, E 30 MPa, slides at 2 m/s, friction 0.3",
      .closedForm = "the way to the stop, v^2 / (2 mu g), 0.68 m",
      .error = "relative error of the way",
      .runs = substepRuns("", runElements)};
  for (const double rate : {60.0, 240.0, 1000.0})
    c.runs.push_back(
        {"Bullet's rigid box", rounded(rate) + " Hz", false, true, [=] { return runStock(rate); }});
  return c;
}

}  // namespace rubble::demo
