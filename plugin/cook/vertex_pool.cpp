#include <algorithm>

#include "cook/contradiction.h"
#include "cook/random.h"
#include "cook/surface_pass.h"

namespace rubble::cooking {

std::size_t VertexPool::KeyHash::operator()(const Key& key) const {
  const std::uint64_t low = key[0] | (std::uint64_t{key[1]} << 32);
  const std::uint64_t high = key[2] | (std::uint64_t{key[3]} << 32);
  return mix(mix(low) + high);
}

VertexPool::VertexPool(const CheckedMesh& mesh, const VoronoiDiagram& diagram)
    : m_mesh(mesh),
      m_diagram(diagram),
      m_ofMeshVertex(mesh.vertices.size(), kNoElement),
      m_ofVoronoiVertex(diagram.vertices.size(), kNoElement) {}

std::uint32_t VertexPool::add(const Eigen::Vector3d& place, const std::array<std::uint32_t, 4>& sites) {
  m_positions.push_back(place);
  m_sites.push_back(sites);
  return std::uint32_t(m_positions.size() - 1);
}

std::uint32_t VertexPool::meshVertex(std::uint32_t vertex, std::uint32_t site) {
  std::uint32_t& id = m_ofMeshVertex[vertex];
  if (id == kNoElement) id = add(m_mesh.vertices[vertex], {site, kNoElement, kNoElement, kNoElement});
  return id;
}

std::uint32_t VertexPool::onMeshEdge(std::uint32_t edge, std::uint32_t siteA, std::uint32_t siteB) {
  const std::uint32_t i = std::min(siteA, siteB);
  const std::uint32_t j = std::max(siteA, siteB);
  const auto [entry, isNew] = m_ofKey.try_emplace(Key{edge, i, j, kNoElement}, 0);
  if (isNew) {
    const Eigen::Vector3d& a = m_mesh.vertices[m_mesh.edges[edge][0]];
    const Eigen::Vector3d& b = m_mesh.vertices[m_mesh.edges[edge][1]];
    const Eigen::Vector3d across = m_diagram.points[j] - m_diagram.points[i];
    const Eigen::Vector3d middle = (m_diagram.points[i] + m_diagram.points[j]) / 2;
    const double atA = across.dot(a - middle);
    const double atB = across.dot(b - middle);
    const double share = atA == atB ? 0.5 : std::clamp(atA / (atA - atB), 0.0, 1.0);
    entry->second = add(a + share * (b - a), {i, j, kNoElement, kNoElement});
  }
  return entry->second;
}

std::uint32_t VertexPool::onTriangle(std::uint32_t triangle, std::array<std::uint32_t, 3> sites,
                                     const Eigen::Vector3d& place) {
  std::sort(sites.begin(), sites.end());
  const auto [entry, isNew] = m_ofKey.try_emplace(Key{triangle, sites[0], sites[1], sites[2]}, 0);
  if (isNew) entry->second = add(place, {sites[0], sites[1], sites[2], kNoElement});
  return entry->second;
}

std::uint32_t VertexPool::voronoiVertex(std::uint32_t vertex) {
  std::uint32_t& id = m_ofVoronoiVertex[vertex];
  if (id == kNoElement) {
    const Eigen::Vector3d place = m_diagram.vertexPosition(vertex);
    if (!place.allFinite()) throw Contradiction("four sites lie in a plane");
    id = add(place, m_diagram.vertices[vertex]);
  }
  return id;
}

}  // namespace rubble::cooking
