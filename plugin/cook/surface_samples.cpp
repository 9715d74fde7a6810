#include "cook/surface_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rubble::cooking {
namespace {

double areaOf(const CheckedMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d& origin = mesh.vertices[a];
  return (mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin).norm() / 2;
}

}  // namespace

double surfaceArea(const CheckedMesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += areaOf(mesh, t);
  return area;
}

std::vector<SurfacePlace> sampleSurface(const CheckedMesh& mesh, std::size_t count, Random& random) {
  std::vector<double> upTo;  // area of the triangles up to each
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area += areaOf(mesh, t);
    upTo.push_back(area);
  }
  std::vector<SurfacePlace> places;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = area * (double(k) + random.uniform()) / double(count);
    const auto found = std::upper_bound(upTo.begin(), upTo.end() - 1, at);
    const auto triangle = std::uint32_t(found - upTo.begin());
    const auto& [a, b, c] = mesh.triangles[triangle];
    const double u = std::sqrt(random.uniform());
    const double v = u * random.uniform();
    places.push_back(
        {(1 - u) * mesh.vertices[a] + (u - v) * mesh.vertices[b] + v * mesh.vertices[c], triangle});
  }
  return places;
}

}  // namespace rubble::cooking
