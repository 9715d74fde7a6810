#include "demo/statue_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rubble::demo {
namespace {

// Half a spacing off the plinth's six planes, which therefore come out flat: they are at multiples of it up,
// and half way between to the sides.
constexpr double kSpacing = 0.02;
constexpr double kPlinthHalf = 0.17, kPlinthTop = 0.12;
// Limbs flow into one another over this length.
constexpr double kBlend = 0.04;

// A line with a radius at each end.
struct Limb {
  Eigen::Vector3d from, to;
  double thickFrom, thickTo;
};

const Limb kLimbs[] = {
    {{0, 0.1, 0}, {0, 0.54, 0}, 0.125, 0.07},           // robe
    {{-0.06, 0.63, 0}, {0.06, 0.63, 0}, 0.07, 0.07},    // chest
    {{0, 0.66, 0}, {0, 0.75, 0.005}, 0.036, 0.036},     // neck
    {{0, 0.79, 0.01}, {0, 0.81, 0.01}, 0.056, 0.056},   // head
    {{0.11, 0.66, 0}, {0.2, 0.72, 0.02}, 0.04, 0.036},  // arm that is up
    {{0.2, 0.72, 0.02}, {0.19, 0.88, 0.05}, 0.036, 0.034},
    {{0.19, 0.9, 0.05}, {0.19, 0.95, 0.05}, 0.044, 0.044},  // what it holds
    {{-0.11, 0.66, 0}, {-0.2, 0.54, -0.02}, 0.04, 0.036},   // arm on the hip
    {{-0.2, 0.54, -0.02}, {-0.09, 0.44, 0.04}, 0.036, 0.034},
};

double distance(const Limb& limb, const Eigen::Vector3d& place) {
  const Eigen::Vector3d along = limb.to - limb.from;
  const double share = std::clamp((place - limb.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const double thick = limb.thickFrom + share * (limb.thickTo - limb.thickFrom);
  return (place - limb.from - share * along).norm() - thick;
}

// The smaller, rounded where the two are nearly equal.
double blended(double a, double b) {
  const double share = std::max(0.0, kBlend - std::abs(a - b)) / kBlend;
  return std::min(a, b) - kBlend * share * share / 4;
}

}  // namespace

double statueField(const Eigen::Vector3d& place) {
  double figure = distance(kLimbs[0], place);
  for (const Limb& limb : kLimbs) figure = blended(figure, distance(limb, place));
  const double plinth = std::max({std::abs(place.x()) - kPlinthHalf, std::abs(place.z()) - kPlinthHalf,
                                  place.y() - kPlinthTop, -place.y()});
  return std::min(std::max(figure, -place.y()), plinth);
}

SurfaceMesh statueMesh(const Eigen::Vector3d& size) {
  SurfaceMesh mesh =
      implicitMesh(statueField, {{-14 * kSpacing, -1.5 * kSpacing, -11 * kSpacing}, kSpacing, {29, 54, 23}});
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex = (vertex - bounds.center()).cwiseQuotient(bounds.sizes()).cwiseProduct(size);
  return mesh;
}

}  // namespace rubble::demo
