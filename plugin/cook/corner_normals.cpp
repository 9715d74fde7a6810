#include "cook/corner_normals.h"

#include <algorithm>
#include <cmath>

namespace rubble::cooking {
namespace {

constexpr double kSmoothCosine = 0.86602540378443865;  // of 30 degrees

// All triangles that meet smoothly at a vertex have one normal there, but for rounding, so that of a hub of
// this many is found once: for each of them anew it was the square of their count.
constexpr std::size_t kManyAround = 2048;

std::size_t cornerOf(const CheckedMesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
  const auto& corners = mesh.triangles[triangle];
  return std::size_t(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

double angleAt(const CheckedMesh& mesh, std::uint32_t triangle, std::size_t corner) {
  const auto& corners = mesh.triangles[triangle];
  const Eigen::Vector3d& at = mesh.vertices[corners[corner]];
  const Eigen::Vector3d a = mesh.vertices[corners[(corner + 1) % 3]] - at;
  const Eigen::Vector3d b = mesh.vertices[corners[(corner + 2) % 3]] - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

using Angles = std::vector<std::array<double, 3>>;

Angles anglesOf(const CheckedMesh& mesh) {
  Angles angles(mesh.triangles.size());
  for (std::uint32_t t = 0; t < angles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) angles[t][corner] = angleAt(mesh, t, corner);
  return angles;
}

// A corner of a triangle.
struct TriangleCorner {
  std::uint32_t triangle;
  std::size_t corner;
};

// Adds the triangles met going round the vertex from `start`, one way or the other, up to a sharp edge. True:
// all round.
bool addAround(const CheckedMesh& mesh, const Angles& angles, std::uint32_t start, std::uint32_t vertex,
               bool forward, Eigen::Vector3d& sum, std::vector<TriangleCorner>& met) {
  for (std::uint32_t at = start;;) {
    const std::size_t corner = cornerOf(mesh, at, vertex);
    const std::uint32_t next = mesh.neighbours[at][forward ? (corner + 2) % 3 : corner];
    if (mesh.normals[at].dot(mesh.normals[next]) <= kSmoothCosine) return false;
    if (next == start) return true;
    met.push_back({next, cornerOf(mesh, next, vertex)});
    sum += angles[next][met.back().corner] * mesh.normals[next];
    at = next;
  }
}

}  // namespace

std::vector<std::array<Eigen::Vector3d, 3>> cornerNormals(const CheckedMesh& mesh) {
  const Angles angles = anglesOf(mesh);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  std::vector<std::array<Eigen::Vector3d, 3>> normals(mesh.triangles.size(), {none, none, none});
  std::vector<TriangleCorner> met;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (!normals[t][corner].isZero(0)) continue;
      const std::uint32_t vertex = mesh.triangles[t][corner];
      Eigen::Vector3d sum = angles[t][corner] * mesh.normals[t];
      met.clear();
      if (!addAround(mesh, angles, t, vertex, true, sum, met))
        addAround(mesh, angles, t, vertex, false, sum, met);
      const double length = sum.norm();
      normals[t][corner] = length > 0 ? Eigen::Vector3d(sum / length) : mesh.normals[t];
      if (met.size() < kManyAround) continue;
      for (const TriangleCorner& other : met) normals[other.triangle][other.corner] = normals[t][corner];
    }
  }
  return normals;
}

}  // namespace rubble::cooking
