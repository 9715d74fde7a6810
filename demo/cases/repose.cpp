// A block lies on a plane that is tilted until it slides: gravity turns, which is the same.
#include <cmath>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace repose {
namespace {

const Eigen::Vector3d kSize(0.4, 0.1, 0.4);  // flat, so that it does not tip [m]
constexpr std::size_t kElements = 32;
constexpr double kDensity = 2400, kModulus = 30e6;  // [kg/m^3], [Pa]
constexpr double kFriction = 0.3, kGravity = 9.81;  // [-], [m/s^2]
constexpr double kStart = 0.26, kRate = 0.035;      // [rad], 2 degrees a second; it stands up to 0.291
constexpr double kSlid = 0.01, kLongest = 3;        // [m], [s]

// Gravity turns with the angle until the block, whose place along the plane is place() [m], has slid that
// far. Returns the angle then.
template <class Place>
double tilt(CaseWorld& world, double tick, Place&& place) {
  double before = place();
  const double start = before;
  for (double time = 0; time < kLongest; time += tick) {
    const double angle = kStart + kRate * (time + tick);
    world.world().setGravity(toBullet(kGravity * Eigen::Vector3d(std::sin(angle), -std::cos(angle), 0)));
    world.step(tick);
    const double now = place();
    if (now - start >= kSlid) return angle - kRate * tick * (now - start - kSlid) / (now - before);
    before = now;
  }
  return 0;  // it never did
}

double errorOf(double angle) {
  return std::abs(angle / slidAngle(kSlid, kFriction, kRate, kGravity) - 1);
}

void addGround(CaseWorld& world) {
  world.add(0, std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), {0, 0, 0})
      .setFriction(1);
}

CaseOutcome runElements(Precision precision, double substepSafety) {
  CaseWorld world(kGravity);
  addGround(world);
  DestructibleBodyDef def;
  def.asset = cookedBox(kSize, kElements);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.friction = kFriction;
  // It lies as deep as its weight presses it in: no drop at the start.
  const double stiffness = def.material.contactStiffness * kModulus / def.asset->spacing();  // [Pa/m]
  def.transform.setOrigin(toBullet({0, kSize.y() / 2 - kDensity * kGravity * kSize.y() / stiffness, 0}));
  const DestructibleBody* block = world.destruct(precision, substepSafety).addBody(def);
  const auto place = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::vector<Eigen::Vector3d> places = placesOf(*block);
    for (const Eigen::Vector3d& p : places) sum += p;
    return sum.x() / double(places.size());
  };
  return world.outcome(errorOf(tilt(world, 1.0 / 240, place)));
}

CaseOutcome runStock(double rate) {
  CaseWorld world(kGravity);
  addGround(world);
  btRigidBody& block = world.add(kDensity * kSize.prod(), std::make_unique<btBoxShape>(toBullet(kSize / 2)),
                                 {0, kSize.y() / 2, 0});
  block.setFriction(btScalar(kFriction));
  const auto place = [&] { return double(block.getWorldTransform().getOrigin().x()); };
  return world.outcome(errorOf(tilt(world, 1 / rate, place)));
}

}  // namespace
}  // namespace repose

double slidAngle(double way, double friction, double rate, double gravity) {
  const double begin = std::atan(friction);
  const auto slid = [&](double angle) {
    const double turned = angle - begin;
    return gravity / (rate * rate) *
           (std::sin(begin) - std::sin(angle) + friction * (std::cos(angle) - std::cos(begin)) +
            turned * (std::cos(begin) + friction * std::sin(begin)));
  };
  double low = begin, high = begin + 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (slid(middle) < way ? low : high) = middle;
  }
  return high;
}

ReportCase reposeCase() {
  using namespace repose;
  ReportCase c{
      .name = "repose",
      .what =
          "A block of 0.4 x 0.1 x 0.4 m, 32 elements, 2400 kg/m3, E 30 MPa, friction 0.3, on a plane that "
          "tilts by 2 degrees a second",
      .closedForm =
          "the angle at which it has slid 1 cm: Coulomb's atan(mu), 16.7 degrees, and the way from there "
          "on by integrating g (sin a - mu cos a) twice",
      .error = "relative error of the angle",
      .runs = substepRuns("", runElements)};
  for (const double rate : {60.0, 240.0, 1000.0})
    c.runs.push_back(
        {"Bullet's rigid box", rounded(rate) + " Hz", false, true, [=] { return runStock(rate); }});
  return c;
}

}  // namespace rubble::demo
