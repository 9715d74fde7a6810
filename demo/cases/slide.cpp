// A block slides over level ground until friction has stopped it.
#include <cmath>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace slide {
namespace {

const Eigen::Vector3d kSize(0.4, 0.1, 0.4);  // flat, so that it does not tip [m]
constexpr std::size_t kElements = 32;
constexpr double kDensity = 2400, kModulus = 30e6;  // [kg/m^3], [Pa]
constexpr double kFriction = 0.3, kGravity = 9.81;  // [-], [m/s^2]
constexpr double kSpeed = 2, kSimulated = 1.2;      // [m/s], [s]; it takes 0.68 s to stop

void addGround(CaseWorld& world) {
  world.add(0, std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), {0, 0, 0})
      .setFriction(1);
}

double errorOf(double way) {
  return std::abs(way / stopDistance(kSpeed, kFriction, kGravity) - 1);
}

CaseOutcome runElements(Precision precision, double substepSafety) {
  constexpr double kTick = 1.0 / 240;  // [s]
  CaseWorld world(kGravity);
  addGround(world);
  DestructibleBodyDef def;
  def.asset = cookedBox(kSize, kElements);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.friction = kFriction;
  // It lies as deep as its weight presses it in: no drop at the start.
  const double stiffness = def.material.contactStiffness * kModulus / def.asset->spacing();  // [Pa/m]
  const double depth = kDensity * kGravity * kSize.y() / stiffness;
  def.transform.setOrigin(toBullet({0, kSize.y() / 2 - depth, 0}));
  def.velocity = toBullet({kSpeed, 0, 0});
  const DestructibleBody* block = world.destruct(precision, substepSafety).addBody(def);
  for (int tick = 0; tick < int(std::lround(kSimulated / kTick)); ++tick) world.step(kTick);
  const std::vector<Eigen::Vector3d> places = placesOf(*block);
  double way = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    way += (places[i] - def.asset->positions[i]).x() / double(places.size());
  return world.outcome(errorOf(way));
}

CaseOutcome runStock(double rate) {
  CaseWorld world(kGravity);
  addGround(world);
  btRigidBody& block = world.add(kDensity * kSize.prod(), std::make_unique<btBoxShape>(toBullet(kSize / 2)),
                                 {0, kSize.y() / 2, 0});
  block.setFriction(btScalar(kFriction));
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
