#include "cook/soup_mesh.h"

#include <numeric>
#include <unordered_map>

namespace rubble::cooking {

TriangleMesh triangleMeshOf(const Soup& soup, const std::vector<std::uint32_t>& chosen) {
  TriangleMesh mesh;
  const auto sources = mesh.add_property_map<MeshFace, Source>("f:source").first;
  std::unordered_map<std::uint32_t, TriangleMesh::Vertex_index> vertices;
  for (const std::uint32_t t : chosen) {
    std::array<TriangleMesh::Vertex_index, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = soup.triangles[t][k];
      const auto [vertex, isNew] = vertices.try_emplace(v);
      if (isNew) vertex->second = mesh.add_vertex(meshPoint(soup.vertices[v]));
      corners[k] = vertex->second;
    }
    const MeshFace face = mesh.add_face(corners[0], corners[1], corners[2]);
    if (face.is_valid()) sources[face] = soup.sources[t];
  }
  return mesh;
}

std::vector<std::uint32_t> allTriangles(const Soup& soup) {
  std::vector<std::uint32_t> all(soup.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

void appendMesh(const TriangleMesh& mesh, Soup& soup) {
  const auto sources = mesh.property_map<MeshFace, Source>("f:source").first;
  std::vector<std::uint32_t> ids(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), kNoElement);
  for (const MeshFace face : mesh.faces()) {
    auto& triangle = soup.triangles.emplace_back();
    std::size_t k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) {
      std::uint32_t& id = ids[vertex];
      if (id == kNoElement) {
        id = std::uint32_t(soup.vertices.size());
        const MeshPoint& p = mesh.point(vertex);
        soup.vertices.emplace_back(p.x(), p.y(), p.z());
      }
      triangle[k++] = id;
    }
    soup.sources.push_back(sources[face]);
  }
}

}  // namespace rubble::cooking
