// What the outer faces of the cells take over from the mesh: normals, texture coordinates, materials.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "cook/checked_mesh.h"
#include "rubble/cook.h"

namespace rubble::cooking {

/// Throws rubble::Error: lists that are neither empty nor one a triangle, numbers that are not finite,
/// materials without a name, names that are none.
void checkLook(const SurfaceMesh& mesh);

/// The look of the surface at any place on it. The mesh has passed checkLook, and `solid` is the same mesh;
/// both must outlive this.
class SurfaceLook {
 public:
  SurfaceLook(const SurfaceMesh& mesh, const CheckedMesh& solid);

  bool hasUvs() const { return !m_mesh.uvs.empty(); }
  bool hasMaterials() const { return !m_mesh.materials.empty() && m_mesh.materialNames.size() > 1; }
  const std::vector<std::string>& materialNames() const { return m_mesh.materialNames; }
  std::uint16_t material(std::uint32_t triangle) const { return m_mesh.materials[triangle]; }

  /// Unit normal at a place on a triangle: between those of its corners, the mesh's own or, where it has
  /// none, cornerNormals'.
  Eigen::Vector3d normal(std::uint32_t triangle, const Eigen::Vector3d& place) const;
  Eigen::Vector2f uv(std::uint32_t triangle, const Eigen::Vector3d& place) const;

 private:
  std::array<double, 3> areasAcross(std::uint32_t triangle, const Eigen::Vector3d& place) const;

  const SurfaceMesh& m_mesh;
  const CheckedMesh& m_solid;
  std::vector<std::array<Eigen::Vector3d, 3>> m_normals;  // unit, of the corners of each triangle
};

}  // namespace rubble::cooking
