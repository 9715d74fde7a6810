#include <algorithm>
#include <utility>

#include "cook/contradiction.h"
#include "cook/surface_pass.h"

namespace rubble::cooking {

VertexPool::VertexPool(const CheckedMesh& mesh, const VoronoiDiagram& diagram)
    : m_mesh(mesh),
      m_diagram(diagram),
      m_ofMeshVertex(mesh.vertices.size(), kNoElement),
      m_ofVoronoiVertex(diagram.vertices.size(), kNoElement),
      m_lastOnEdge(mesh.edges.size(), kNoElement) {}

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

void VertexPool::enter(std::uint32_t triangle) {
  m_triangle = triangle;
  m_ofSites.clear();
  for (std::uint32_t side = 0; side < 3; ++side)
    for (std::uint32_t v = m_lastOnEdge[m_mesh.triangleEdges[triangle][side]]; v != kNoElement;
         v = m_before[v])
      m_ofSites.find({m_sites[v][0], m_sites[v][1], kSideLabel + side}).number = v;
}

std::uint32_t VertexPool::onSide(std::uint32_t side, std::uint32_t siteA, std::uint32_t siteB) {
  const std::uint32_t i = std::min(siteA, siteB);
  const std::uint32_t j = std::max(siteA, siteB);
  const auto [number, isNew] = m_ofSites.find({i, j, kSideLabel + side});
  if (isNew) {
    const std::uint32_t edge = m_mesh.triangleEdges[m_triangle][side];
    const Eigen::Vector3d& a = m_mesh.vertices[m_mesh.edges[edge][0]];
    const Eigen::Vector3d& b = m_mesh.vertices[m_mesh.edges[edge][1]];
    const Eigen::Vector3d across = m_diagram.points[j] - m_diagram.points[i];
    const Eigen::Vector3d middle = (m_diagram.points[i] + m_diagram.points[j]) / 2;
    const double atA = across.dot(a - middle);
    const double atB = across.dot(b - middle);
    const double share = atA == atB ? 0.5 : std::clamp(atA / (atA - atB), 0.0, 1.0);
    number = add(a + share * (b - a), {i, j, kNoElement, kNoElement});
    m_before.resize(m_positions.size(), kNoElement);
    m_before[number] = std::exchange(m_lastOnEdge[edge], number);
  }
  return number;
}

std::uint32_t VertexPool::onTriangle(std::array<std::uint32_t, 3> sites, const Eigen::Vector3d& place) {
  std::sort(sites.begin(), sites.end());
  const auto [number, isNew] = m_ofSites.find(sites);
  if (isNew) number = add(place, {sites[0], sites[1], sites[2], kNoElement});
  return number;
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
