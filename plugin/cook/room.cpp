#include "cook/room.h"

#include <algorithm>

namespace rubble::cooking {
namespace {

constexpr int kTries = 40;               // steps up or halvings of the step
constexpr double kLeastStep = 1.0 / 64;  // of the depth, where the climb is over
constexpr double kEnough = 0.98;         // [radii] what is as deep as this is pushed to the full depth later

}  // namespace

Room findRoomNear(const SignedDistance& distance, const Eigen::Vector3d& start, double radius,
                  bool outOfCorners) {
  Eigen::Vector3d place = start;
  Distance here = distance.exact(place);
  const auto climb = [&](const Eigen::Vector3d& to) {
    Eigen::Vector3d next = to;
    Distance there = distance.exact(next);
    if (there.value >= here.value) return there;
    // Not through a thin wall into what is behind it: unless one place lies in a ball about the other that
    // holds no surface, no farther than the surface is.
    const double length = (to - place).norm();
    if (length > std::max(-here.value, -there.value)) {
      next = place - here.value / length * (to - place);
      there = distance.exact(next);
      if (there.value >= here.value) return there;
    }
    place = next;
    here = there;
    return there;
  };
  double step = radius + here.value;
  for (int tries = 0; tries < kTries && -here.value < kEnough * radius && step > kLeastStep * -here.value;
       ++tries) {
    const double before = here.value;
    const Eigen::Vector3d up = -here.gradient;
    const Distance there = climb(place + step * up);
    if (there.value >= before) {
      // Beyond a ridge, where another side of the solid is nearest: along the ridge, or less far.
      const Eigen::Vector3d along = up - there.gradient;
      constexpr double kOpposite = 0.1;
      if (along.norm() > kOpposite) {
        const Eigen::Vector3d third = climb(place + step * along.normalized()).gradient;
        // In a sharp corner of three sides: away from all of them alike.
        const Eigen::Vector3d out = (up + there.gradient).cross(up + third);
        if (outOfCorners && here.value >= before && out.norm() > kOpposite)
          climb(place + (out.dot(up) < 0 ? -step : step) * out.normalized());
      }
      if (here.value >= before) step /= 2;
    }
    step = std::min(step, radius + here.value);
  }
  const double depth = std::max(0.0, -here.value);
  return {place, depth >= kEnough * radius ? radius : depth};
}

}  // namespace rubble::cooking
