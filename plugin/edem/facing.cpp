#include "edem/facing.h"

#include <algorithm>
#include <limits>

namespace rubble::edem {
namespace {

// Sides up to this many times as far as the nearest have a share.
constexpr double kNear = 4;

// visit(depth, normal) for every side that a point is under, in the part's own frame.
template <class Visit>
void visitSides(const Collider& part, const Eigen::Vector3d& p, Visit&& visit) {
  if (part.kind == Collider::Kind::Box) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0})
        visit(part.rounding + part.size[axis] - side * p[axis],
              Eigen::Vector3d(side * Eigen::Vector3d::Unit(axis)));
    }
  } else if (part.kind == Collider::Kind::Hull) {
    for (const Hull::Face& face : part.hull->faces)
      visit(part.rounding + face.offset - face.normal.dot(p), face.normal);
  }
}

}  // namespace

// Shares (1 - (r - 1) / (kNear - 1))^2 of the sides, r: depth over that of the nearest side.
Facing facing(const Collider& part, const Eigen::Vector3d& point, const Eigen::Vector3d& area) {
  const Eigen::Matrix3d& axes = part.place.linear();
  if (part.kind == Collider::Kind::Plane)  // has one side
    return {-(axes.transpose() * area).dot(part.size), axes * part.size, Eigen::Vector3d::Zero()};
  const Eigen::Vector3d p = axes.transpose() * (point - part.place.translation()),
                        a = axes.transpose() * area;
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  visitSides(part, p, [&](double depth, const Eigen::Vector3d& normal) {
    if (depth >= least) return;
    least = depth;
    nearest = normal;
  });
  if (!(least > 0)) return {-a.dot(nearest), axes * nearest, Eigen::Vector3d::Zero()};
  double shares = 0;
  Facing out;
  const auto visitNear = [&](auto&& act) {
    visitSides(part, p, [&](double depth, const Eigen::Vector3d& normal) {
      const double ratio = depth / least, left = (kNear - ratio) / (kNear - 1);
      if (left > 0) act(ratio, left, normal);
    });
  };
  visitNear([&](double, double left, const Eigen::Vector3d& normal) {
    shares += left * left;
    out.normal += left * left * normal;
  });
  out.normal /= shares;
  out.weight = -a.dot(out.normal);
  visitNear([&](double ratio, double left, const Eigen::Vector3d& normal) {
    const double rise = -2 * left / (kNear - 1) / shares;  // of the share, with the ratio
    out.slope += rise * (-a.dot(normal) - out.weight) * (ratio * nearest - normal) / least;
  });
  out.normal = axes * out.normal;
  out.slope = axes * out.slope;
  return out;
}

}  // namespace rubble::edem
