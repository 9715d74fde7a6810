// A surface of triangles that stands for itself, not for a solid: what lies behind it is no inside, and
// either of its sides can be touched. Terrain and level geometry of the host.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <unsupported/Eigen/BVH>

#include "edem/types.h"

namespace rubble::edem {

/// Nearest point of a mesh, or of one of its triangles.
struct MeshPoint {
  Eigen::Vector3d at;
  std::uint32_t triangle;
  double distance;  ///< not negative [m]
};

class TriangleMesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Triangles that share two vertices are turned alike, where they can be; those without area are left out.
  TriangleMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles);

  std::span<const Triangle> triangles() const { return m_triangles; }
  const Eigen::Vector3d& corner(std::uint32_t triangle, unsigned c) const {
    return m_vertices[m_triangles[triangle][c]];
  }
  const Eigen::Vector3d& normal(std::uint32_t triangle) const { return m_normals[triangle]; }  ///< unit
  const Eigen::AlignedBox3d& bounds() const { return m_bounds; }
  MeshPoint nearest(std::uint32_t triangle, const Eigen::Vector3d& to) const;

  /// Nearest of all triangles; of those that are equally near the one that most faces `to`. Its distance is
  /// infinite where none is within `reach`.
  MeshPoint nearest(const Eigen::Vector3d& to, double reach = std::numeric_limits<double>::infinity()) const;
  /// Of those given, by the same rule.
  MeshPoint nearest(std::span<const std::uint32_t> triangles, const Eigen::Vector3d& to) const;
  /// The triangles within `reach` of a place, rising.
  void gather(const Eigen::Vector3d& place, double reach, std::vector<std::uint32_t>& found) const;

 private:
  void turnAlike();

  std::vector<Eigen::Vector3d> m_vertices;
  std::vector<Triangle> m_triangles;
  std::vector<Eigen::Vector3d> m_normals;
  Eigen::AlignedBox3d m_bounds;
  Eigen::KdBVH<double, 3, std::uint32_t> m_tree;
};

}  // namespace rubble::edem
