#include "cook/corner_normals.h"

#include <algorithm>
#include <cmath>

namespace rubble::cooking {
namespace {

constexpr double kSmoothCosine = 0.86602540378443865;  // of 30 degrees

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

// Adds the triangles met going round the vertex from `start`, one way or the other, up to a sharp edge. True:
// all round.
bool addAround(const CheckedMesh& mesh, std::uint32_t start, std::uint32_t vertex, bool forward,
               Eigen::Vector3d& sum) {
  for (std::uint32_t at = start;;) {
    const std::size_t corner = cornerOf(mesh, at, vertex);
    const std::uint32_t next = mesh.neighbours[at][forward ? (corner + 2) % 3 : corner];
    if (mesh.normals[at].dot(mesh.normals[next]) <= kSmoothCosine) return false;
    if (next == start) return true;
    sum += angleAt(mesh, next, cornerOf(mesh, next, vertex)) * mesh.normals[next];
    at = next;
  }
}

}  // namespace

std::vector<std::array<Eigen::Vector3d, 3>> cornerNormals(const CheckedMesh& mesh) {
  std::vector<std::array<Eigen::Vector3d, 3>> normals(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[t][corner];
      Eigen::Vector3d sum = angleAt(mesh, t, corner) * mesh.normals[t];
      if (!addAround(mesh, t, vertex, true, sum)) addAround(mesh, t, vertex, false, sum);
      const double length = sum.norm();
      normals[t][corner] = length > 0 ? Eigen::Vector3d(sum / length) : mesh.normals[t];
    }
  }
  return normals;
}

}  // namespace rubble::cooking
