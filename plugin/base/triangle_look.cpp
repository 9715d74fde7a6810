#include "rubble/triangle_look.h"

namespace rubble {

Eigen::Vector2f boxUv(const Eigen::Vector3f& place, const Eigen::Vector3f& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const float side = normal[axis] < 0 ? -1.0f : 1.0f;
  if (axis == 0) return {-side * place.z(), place.y()};
  if (axis == 1) return {place.x(), -side * place.z()};
  return {side * place.x(), place.y()};
}

std::vector<TriangleLook> triangleLooks(const Asset& asset) {
  std::vector<TriangleLook> looks;
  looks.reserve(asset.triangles.size());
  for (const Cell& cell : asset.cells)
    for (std::uint32_t t = 0; t < cell.outerTriangles + cell.innerTriangles; ++t) {
      const std::uint32_t triangle = cell.firstTriangle + t;
      const bool isOuter = t < cell.outerTriangles;
      TriangleLook& look = looks.emplace_back();
      look.material = isOuter ? 0 : asset.innerMaterial();
      if (!asset.materials.empty()) look.material = asset.materials[triangle];
      Eigen::Vector3f normal = Eigen::Vector3f::Zero();
      for (const std::uint32_t corner : asset.triangles[triangle]) normal += asset.corners[corner].normal;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = asset.triangles[triangle][k];
        look.uvs[k] = asset.uvs.empty() ? boxUv(asset.vertices[asset.corners[corner].vertex].position, normal)
                                        : asset.uvs[corner];
      }
    }
  return looks;
}

}  // namespace rubble
