// Soups as meshes of CGAL; only for the files that are its doors.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <vector>

#include "cook/soup.h"

namespace rubble::cooking {

using MeshKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using MeshPoint = MeshKernel::Point_3;
using TriangleMesh = CGAL::Surface_mesh<MeshPoint>;
using MeshFace = TriangleMesh::Face_index;

inline MeshPoint meshPoint(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// The triangles `chosen` as a mesh, their sources in the property "f:source". Those that CGAL does not take
/// are left out.
TriangleMesh triangleMeshOf(const Soup& soup, const std::vector<std::uint32_t>& chosen);

std::vector<std::uint32_t> allTriangles(const Soup& soup);

void appendMesh(const TriangleMesh& mesh, Soup& soup);

}  // namespace rubble::cooking
