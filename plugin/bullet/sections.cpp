#include "bullet/sections.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

constexpr int kRimDirections = 16;

// Sums over the pieces of a section's boundary, counter-clockwise about its axis: each adds the triangle that
// it makes with the origin.
struct Outline {
  double area = 0, u = 0, v = 0, uu = 0, vv = 0, uv = 0;
  std::vector<Eigen::Vector2d> points;

  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const double twice = a.x() * b.y() - a.y() * b.x();
    area += twice / 2;
    u += twice * (a.x() + b.x()) / 6;
    v += twice * (a.y() + b.y()) / 6;
    uu += twice * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
    vv += twice * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
    uv += twice * (2 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2 * b.x() * b.y()) / 24;
    points.push_back(a);
    points.push_back(b);
  }
};

using Triangle = std::array<Eigen::Vector3d, 3>;

// Where a triangle crosses the plane, in the plane's axes.
std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> crossing(const Triangle& t, int axis, double at) {
  std::array<Eigen::Vector2d, 2> ends;
  int found = 0;
  for (std::size_t c = 0; c < 3 && found < 2; ++c) {
    const Eigen::Vector3d &p = t[c], &q = t[(c + 1) % 3];
    if ((p[axis] < at) == (q[axis] < at)) continue;
    const Eigen::Vector3d x = p + (at - p[axis]) / (q[axis] - p[axis]) * (q - p);
    ends[std::size_t(found++)] = {x[(axis + 1) % 3], x[(axis + 2) % 3]};
  }
  if (found < 2) return std::nullopt;
  // The inside is to the left.
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const Eigen::Vector2d along(-normal[(axis + 2) % 3], normal[(axis + 1) % 3]);
  if (along.dot(ends[1] - ends[0]) < 0) std::swap(ends[0], ends[1]);
  return std::pair(ends[0], ends[1]);
}

// Torque over largest shear stress of the rectangle of the same area and least second moment, b t^2 / (3 +
// 1.8 t / b) [TimoshenkoGoodier70, 109]; a quarter less than that of a circle.
double twistOf(const Section& s) {
  const double mean = 0.5 * (s.uu + s.vv), least = mean - std::hypot(0.5 * (s.uu - s.vv), s.uv);
  const double thin = std::sqrt(12 * least / s.area), wide = s.area / thin;
  return wide * thin * thin / (3 + 1.8 * thin / wide);
}

void fillSurface(const std::vector<Triangle>& triangles, Section& s) {
  Outline all;
  for (const Triangle& t : triangles)
    if (const auto piece = crossing(t, s.axis, s.at)) all.add(piece->first, piece->second);
  if (!(all.area > 0)) return;
  const Eigen::Vector2d middle(all.u / all.area, all.v / all.area);
  s.area = all.area;
  s.centroid[s.axis] = s.at;
  s.centroid[(s.axis + 1) % 3] = middle.x();
  s.centroid[(s.axis + 2) % 3] = middle.y();
  s.uu = all.uu - all.area * middle.x() * middle.x();
  s.vv = all.vv - all.area * middle.y() * middle.y();
  s.uv = all.uv - all.area * middle.x() * middle.y();
  s.twist = twistOf(s);
  for (int d = 0; d < kRimDirections; ++d) {
    const double angle = 2 * std::numbers::pi * (d + 0.5) / kRimDirections;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d furthest =
        *std::max_element(all.points.begin(), all.points.end(),
                          [&](const auto& a, const auto& b) { return a.dot(direction) < b.dot(direction); });
    const Eigen::Vector2d arm = furthest - middle;
    if (std::find(s.rim.begin(), s.rim.end(), arm) == s.rim.end()) s.rim.push_back(arm);
  }
}

}  // namespace

Wrench& Wrench::operator+=(const Wrench& other) {
  force += other.force;
  moment += other.moment;
  return *this;
}

void SpreadWeight::add(double added, const Eigen::Vector3d& at, double inertia) {
  weight += added;
  first += added * at;
  second += added * at * at.transpose() + 0.5 * inertia * Eigen::Matrix3d::Identity();
}

Wrench SpreadWeight::under(const LinearField& field) const {
  const Eigen::Matrix3d turned = field.slope * second;
  return {
      weight * field.offset + field.slope * first,
      first.cross(field.offset) + Eigen::Vector3d(turned(2, 1) - turned(1, 2), turned(0, 2) - turned(2, 0),
                                                  turned(1, 0) - turned(0, 1))};
}

Eigen::Matrix3d SpreadWeight::inertia() const {
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

Sections sectionsOf(const Asset& asset, const Eigen::Isometry3d& frame, const Eigen::Vector3d& centre,
                    std::span<const double> masses, std::span<const double> inertias) {
  const Eigen::Isometry3d into = Eigen::Translation3d(-centre) * frame.inverse();
  std::vector<Triangle> triangles;
  Eigen::AlignedBox3d box;
  for (const Cell& cell : asset.cells) {
    for (std::uint32_t t = cell.firstTriangle; t < cell.firstTriangle + cell.outerTriangles; ++t) {
      Triangle& corners = triangles.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = asset.corners[asset.triangles[t][c]].vertex;
        corners[c] = into * asset.vertices[vertex].position.cast<double>();
        box.extend(corners[c]);
      }
    }
  }
  Sections all;
  all.spacing = asset.spacing();
  all.length = box.sizes().maxCoeff();
  all.thickness = box.sizes().minCoeff();
  for (std::size_t c = 0; c < kCuts; ++c) {
    Section& s = all.cuts[c];
    s.axis = int(c) / kCutsPerAxis;
    s.at = box.min()[s.axis] + (int(c) % kCutsPerAxis + 1) * box.sizes()[s.axis] / (kCutsPerAxis + 1);
    fillSurface(triangles, s);
  }
  const auto addTo = [&](SpreadWeight Sections::*whole, SpreadWeight Section::*part, double weight,
                         const Eigen::Vector3d& at, double inertia) {
    (all.*whole).add(weight, at, inertia);
    for (Section& s : all.cuts)
      if (at[s.axis] > s.at) (s.*part).add(weight, at, inertia);
  };
  for (std::size_t i = 0; i < asset.elementCount(); ++i)
    addTo(&Sections::mass, &Section::mass, masses[i], into * asset.positions[i], inertias[i]);
  // A tied surface as a square: its own inertia lets a single one take moments.
  for (const AssetAnchor& a : asset.anchors)
    addTo(&Sections::anchors, &Section::anchors, a.area, into * a.point, a.area * a.area / 12);
  return all;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
