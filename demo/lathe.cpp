#include "demo/lathe.h"

#include <cmath>
#include <numbers>

namespace rubble::demo {
namespace {

// One row of `segments` vertices for each point of the profile; counter-clockwise about y, from +z to +x.
void addRows(SurfaceMesh& mesh, const Profile& profile, std::uint32_t segments) {
  for (const Eigen::Vector2d& point : profile)
    for (std::uint32_t k = 0; k < segments; ++k) {
      const double angle = 2 * std::numbers::pi * k / segments;
      mesh.vertices.emplace_back(point.x() * std::sin(angle), point.y(), point.x() * std::cos(angle));
    }
}

// The flat strips between two rows, the upper of which comes later in the profile.
void addBand(SurfaceMesh& mesh, std::uint32_t lower, std::uint32_t upper, std::uint32_t segments) {
  for (std::uint32_t k = 0; k < segments; ++k) {
    const std::uint32_t next = (k + 1) % segments;
    mesh.triangles.push_back({lower + k, lower + next, upper + next});
    mesh.triangles.push_back({lower + k, upper + next, upper + k});
  }
}

}  // namespace

SurfaceMesh latheMesh(const Profile& profile, std::uint32_t segments) {
  SurfaceMesh mesh;
  addRows(mesh, Profile(profile.begin() + 1, profile.end() - 1), segments);
  const auto rows = std::uint32_t(profile.size() - 2);
  for (std::uint32_t row = 0; row + 1 < rows; ++row)
    addBand(mesh, row * segments, (row + 1) * segments, segments);
  const auto foot = std::uint32_t(mesh.vertices.size()), head = foot + 1;
  mesh.vertices.emplace_back(0, profile.front().y(), 0);
  mesh.vertices.emplace_back(0, profile.back().y(), 0);
  const std::uint32_t last = (rows - 1) * segments;
  for (std::uint32_t k = 0; k < segments; ++k) {
    const std::uint32_t next = (k + 1) % segments;
    mesh.triangles.push_back({foot, next, k});
    mesh.triangles.push_back({head, last + k, last + next});
  }
  return mesh;
}

SurfaceMesh ringMesh(const Profile& profile, std::uint32_t segments) {
  SurfaceMesh mesh;
  addRows(mesh, profile, segments);
  const auto rows = std::uint32_t(profile.size());
  for (std::uint32_t row = 0; row < rows; ++row)
    addBand(mesh, row * segments, (row + 1) % rows * segments, segments);
  return mesh;
}

SurfaceMesh unitCylinder(std::uint32_t segments) {
  return latheMesh({{0, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {0, 0.5}}, segments);
}

SurfaceMesh unitSphere(std::uint32_t segments) {
  const std::uint32_t bands = segments / 2;
  Profile profile = {{0, -0.5}};
  for (std::uint32_t i = 1; i < bands; ++i) {
    const double angle = std::numbers::pi * i / bands;
    profile.emplace_back(std::sin(angle) / 2, -std::cos(angle) / 2);
  }
  profile.emplace_back(0, 0.5);
  return latheMesh(profile, segments);
}

SurfaceMesh torusMesh(double outer, double tube, std::uint32_t segments) {
  Profile profile;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    profile.emplace_back(outer / 2 - tube / 2 * (1 - std::cos(angle)), tube / 2 * std::sin(angle));
  }
  return ringMesh(profile, segments);
}

}  // namespace rubble::demo
