// A block lies on a plane that is tilted until it slides: gravity turns, which is the same.
#include <cmath>

#include "demo/cases/block_on_ground.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace repose {
namespace {

constexpr double kStart = 0.26, kRate = 0.035;  // [rad], 2 degrees a second; it stands up to 0.291
constexpr double kSlid = 0.01, kLongest = 3;    // [m], [s]

// Gravity turns with the angle until the block, whose place along the plane is place() [m], has slid that
// far. Returns the angle then.
template <class Place>
double tilt(CaseWorld& world, double tick, Place&& place) {
  double before = place();
  const double start = before;
  for (double time = 0; time < kLongest; time += tick) {
    const double angle = kStart + kRate * (time + tick);
    world.world().setGravity(
        toBullet(block::kGravity * Eigen::Vector3d(std::sin(angle), -std::cos(angle), 0)));
    world.step(tick);
    const double now = place();
    if (now - start >= kSlid) return angle - kRate * tick * (now - start - kSlid) / (now - before);
    before = now;
  }
  return 0;  // it never did
}

double errorOf(double angle) {
  return std::abs(angle / slidAngle(kSlid, block::kFriction, kRate, block::kGravity) - 1);
}

CaseOutcome runElements(Precision precision, double substepSafety) {
  CaseWorld world(block::kGravity);
  const DestructibleBody* block = block::add(world, precision, substepSafety, {0, 0, 0});
  const auto place = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::vector<Eigen::Vector3d> places = placesOf(*block);
    for (const Eigen::Vector3d& p : places) sum += p;
    return sum.x() / double(places.size());
  };
  return world.outcome(errorOf(tilt(world, 1.0 / 240, place)));
}

CaseOutcome runStock(double rate) {
  CaseWorld world(block::kGravity);
  const btRigidBody& block = block::addStock(world);
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
