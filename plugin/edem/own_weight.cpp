#include "edem/own_weight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace rubble::edem {
namespace {

constexpr double kKilometre = 1000, kMillimetre = 1e-3;  // longest edges that are asked about [m]
constexpr double kLikelyMillimetres = 100;               // a body that breaks itself and is as long [m]

std::string number(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

std::string pressure(double pascals) {
  if (pascals >= 1e6) return number(pascals / 1e6) + " MPa";
  if (pascals >= 1e3) return number(pascals / 1e3) + " kPa";
  return number(pascals) + " Pa";
}

std::string length(double metres) {
  return metres >= kKilometre   ? number(metres / 1000) + " km"
         : metres < kMillimetre ? number(metres * 1000) + " mm"
                                : number(metres) + " m";
}

// Lowest and highest of the body's cells along the direction, from the asset's origin [m].
std::pair<double, double> extent(const Asset& asset, const Eigen::Vector3d& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const CellVertex& vertex : asset.vertices) {
    const double at = vertex.position.cast<double>().dot(direction);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {low, high};
}

double heightOf(const Asset& asset, const Eigen::Isometry3d& place, const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d up =
      gravity.norm() > 0 ? Eigen::Vector3d(-gravity.normalized()) : Eigen::Vector3d::UnitY();
  const auto [low, high] = extent(asset, place.linear().transpose() * up);
  return std::max(0.0, high - low);
}

// Height of the tied points' mean over the body's middle, as a share of half its height: 1 hangs by its top.
double anchorHeight(const WeightQuestion& q) {
  if (!q.anchored || q.asset.anchors.empty()) return -1;
  const Eigen::Vector3d up = q.place.linear().transpose() * -q.gravity.normalized();
  const auto [low, high] = extent(q.asset, up);
  double sum = 0, area = 0;
  for (const AssetAnchor& anchor : q.asset.anchors) {
    sum += anchor.area * anchor.point.dot(up);
    area += anchor.area;
  }
  return (sum / area - (low + high) / 2) / ((high - low) / 2);
}

std::string weightAdvice(const WeightQuestion& q) {
  // The criterion `stretch` knows no strength.
  if (!(q.gravity.norm() > 0) || q.model.breakCriterion != BreakCriterion::MohrCoulomb) return "";
  constexpr double kSide = 0.5;  // anchors nearer to the middle carry by bending, which this does not judge
  const double at = anchorHeight(q);
  if (std::abs(at) < kSide) return "";
  const bool hangs = at > 0;
  // Of a prism on its foot, or at its ceiling: rho g H.
  const double stress = q.material.density * q.gravity.norm() * heightOf(q.asset, q.place, q.gravity);
  const double strength = hangs ? q.material.tensileStrength : q.material.compressiveStrength;
  if (!(stress > strength)) return "";
  return std::string("its own weight ") + (hangs ? "pulls at its top with " : "presses its foot with ") +
         pressure(stress) + ", more than its " + (hangs ? "tensile" : "compressive") + " strength of " +
         pressure(strength);
}

}  // namespace

std::string sizeAndWeightAdvice(const WeightQuestion& q) {
  const double longest = q.asset.bounds().sizes().maxCoeff();
  const std::string weight = weightAdvice(q);
  std::string text = weight;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (longest >= kKilometre) {
    add("it is " + length(longest) + " long: are these millimetres?");
  } else if (longest < kMillimetre) {
    add("it is " + length(longest) + " long: lengths are metres");
  } else if (!weight.empty() && longest >= kLikelyMillimetres) {
    add("are these millimetres?");
  }
  return text;
}

std::string bodyName(std::uint32_t id, const Material& material, const Asset& asset,
                     const Eigen::Isometry3d& place, const Eigen::Vector3d& gravity) {
  return "body " + std::to_string(id) + " (" + material.name + ", " +
         length(heightOf(asset, place, gravity)) + " tall)";
}

}  // namespace rubble::edem
