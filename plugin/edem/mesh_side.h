// A triangle mesh as an element sees it that touches it from one side.
//
// A mesh has no inside. What of an element is through it is what lies beyond it from the element's centre,
// whichever way its triangles are turned, and is as deep as it is away from the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "edem/collider.h"
#include "edem/facing.h"
#include "edem/triangle_mesh.h"

namespace rubble::edem {

class MeshSide {
 public:
  /// Of an element with its centre at `centre`, frame of the mesh, with points up to `reach` from it [m]. The
  /// mesh must outlive it.
  void look(const TriangleMesh& mesh, const Eigen::Vector3d& centre, double reach);

  /// Of the element's centre, infinitely far where nothing is near: the nearest point, not negative.
  SurfacePoint centre() const;
  /// Of a point of the element: its distance, negative beyond the mesh, and the way out to the centre's side.
  SurfacePoint nearest(const Eigen::Vector3d& point) const;
  /// Whether the mesh is between it and the centre.
  bool isBeyond(const Eigen::Vector3d& point) const;

  /// How much of a vertex of vector area `area` looks at the triangles near it, see facing.h.
  Facing facing(const Eigen::Vector3d& point, const Eigen::Vector3d& area) const;

 private:
  bool crosses(std::uint32_t triangle, const Eigen::Vector3d& way) const;
  Eigen::Vector3d normalOf(std::uint32_t triangle) const;

  const TriangleMesh* m_mesh = nullptr;
  Eigen::Vector3d m_centre;
  MeshPoint m_nearest;                     // to it
  std::vector<std::uint32_t> m_triangles;  // near, rising
  std::vector<std::uint8_t> m_inFront;     // beside them: of which the centre is in front
  bool m_behind = false;                   // the centre is behind the nearest
};

}  // namespace rubble::edem
