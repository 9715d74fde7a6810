#include "render/cell_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "rubble/error.h"

namespace rubble::render {
namespace {

constexpr std::uint16_t kNothingAcross = 0xffff;
constexpr std::uint32_t kNoCorner = 0xffffffffu;
constexpr std::size_t kMaxVertices = std::size_t{1} << 30;  // a vertex and its owner's place share 32 bits

// Orthonormal axes along which a cell's outermost corners are looked for; askew, or the corners of a box
// would tie.
const Eigen::Matrix3f kAxes = Eigen::Quaternionf(0.8f, 0.3f, 0.5f, 0.2f).normalized().toRotationMatrix();
constexpr float kMostCoarseScale = 1.6f;  // of a flat cell's octahedron

std::uint32_t packNormal(const Eigen::Vector3f& normal, bool inner) {
  const auto ten = [](float x) {
    return std::uint32_t(std::lround(std::clamp(x, -1.f, 1.f) * 511.f)) & 1023u;
  };
  return ten(normal.x()) | ten(normal.y()) << 10 | ten(normal.z()) << 20 | (inner ? 1u : 0u) << 30;
}

unsigned placeOf(const CellVertex& vertex, std::uint32_t element) {
  const auto it = std::find(vertex.elements.begin(), vertex.elements.end(), element);
  if (it == vertex.elements.end()) {
    throw Error("asset: corner of cell " + std::to_string(element) +
                ": its vertex does not list that element");
  }
  return unsigned(it - vertex.elements.begin());
}

}  // namespace

CellMesh::CellMesh(const Asset& asset) {
  if (asset.vertices.size() >= kMaxVertices)
    throw Error("asset: more than 2^30 cell vertices cannot be drawn");
  m_vertices.reserve(asset.vertices.size());
  for (const CellVertex& vertex : asset.vertices) {
    const Eigen::Vector3f& p = vertex.position;
    m_vertices.push_back({{p.x(), p.y(), p.z(), 0}, vertex.elements});
  }
  for (auto& copies : m_cornerOf) copies.assign(asset.corners.size(), kNoCorner);
  m_corners.reserve(asset.corners.size());
  m_triangles.reserve(asset.triangles.size());
  for (std::uint32_t element = 0; element < asset.cells.size(); ++element) {
    const Cell& cell = asset.cells[element];
    for (std::uint32_t i = 0; i < cell.outerTriangles + cell.innerTriangles; ++i) {
      const bool inner = i >= cell.outerTriangles;
      const auto& corners = asset.triangles[cell.firstTriangle + i];
      m_triangles.push_back({corner(asset, corners[0], inner), corner(asset, corners[1], inner),
                             corner(asset, corners[2], inner)});
      m_owners.push_back(element);
      m_placesAcross.push_back(inner ? placesAcross(asset, cell.firstTriangle + i, element) : kNothingAcross);
    }
    const std::span<const std::array<std::uint32_t, 3>> drawn(m_triangles);
    addCoarse(asset, element, drawn.last(cell.outerTriangles + cell.innerTriangles));
  }
  m_cornerOf = {};
}

std::uint32_t CellMesh::corner(const Asset& asset, std::uint32_t assetCorner, bool inner) {
  std::uint32_t& copy = m_cornerOf[inner ? 1 : 0][assetCorner];
  if (copy == kNoCorner) {
    const CellCorner& source = asset.corners[assetCorner];
    const unsigned place = placeOf(asset.vertices[source.vertex], source.element);
    copy = std::uint32_t(m_corners.size());
    m_corners.push_back({source.vertex * 4 + place, packNormal(source.normal, inner)});
  }
  return copy;
}

void CellMesh::addCoarse(const Asset& asset, std::uint32_t element,
                         std::span<const std::array<std::uint32_t, 3>> triangles) {
  const auto position = [&](std::uint32_t c) {
    return Eigen::Vector3f(asset.vertices[m_corners[c].vertexAndOwner / 4].position);
  };
  std::array<std::uint32_t, 6> outermost{};  // by axis, then side
  for (unsigned d = 0; d < 6; ++d) {
    const Eigen::Vector3f direction = (d % 2 == 0 ? 1.f : -1.f) * kAxes.col(d / 2);
    float farthest = -std::numeric_limits<float>::infinity();
    for (const auto& triangle : triangles) {
      for (const std::uint32_t c : triangle) {
        if (position(c).dot(direction) <= farthest) continue;
        farthest = position(c).dot(direction);
        outermost[d] = c;
      }
    }
  }
  float volume = 0;
  const Eigen::Vector3f centre = asset.positions[element].cast<float>();
  for (unsigned octant = 0; octant < kCoarseTriangles; ++octant) {
    const unsigned x = octant & 1u, y = octant >> 1 & 1u, z = octant >> 2 & 1u;
    std::array<std::uint32_t, 3> triangle{outermost[x], outermost[2 + y], outermost[4 + z]};
    if ((x + y + z) % 2 == 1) std::swap(triangle[1], triangle[2]);  // a mirrored octant turns the other way
    const Eigen::Vector3f a = position(triangle[0]) - centre, b = position(triangle[1]) - centre;
    volume += a.cross(b).dot(position(triangle[2]) - centre) / 6;
    m_coarse.push_back(triangle);
  }
  const float ratio = float(asset.volumes[element]) / std::max(volume, std::numeric_limits<float>::min());
  m_coarseScales.push_back(std::min(std::cbrt(ratio), kMostCoarseScale));
}

// The element behind an inner triangle: the only other one that all three vertices share; between several
// (slivers), the one whose face looks most nearly the triangle's way.
std::uint16_t CellMesh::placesAcross(const Asset& asset, std::uint32_t triangle,
                                     std::uint32_t element) const {
  std::array<const CellVertex*, 3> v{};
  for (unsigned c = 0; c < 3; ++c) v[c] = &asset.vertices[asset.corners[asset.triangles[triangle][c]].vertex];
  const Eigen::Vector3f normal = asset.corners[asset.triangles[triangle][0]].normal;
  std::uint32_t across = kNoElement;
  float best = -2;
  for (const std::uint32_t candidate : v[0]->elements) {
    if (candidate == kNoElement || candidate == element) continue;
    if (std::count(v[1]->elements.begin(), v[1]->elements.end(), candidate) == 0) continue;
    if (std::count(v[2]->elements.begin(), v[2]->elements.end(), candidate) == 0) continue;
    float likeness = -1;
    const Cell& cell = asset.cells[element];
    for (std::uint32_t f = cell.firstFace; f < cell.firstFace + cell.faceCount; ++f) {
      if (asset.faces[f].neighbour == candidate)
        likeness = std::max(likeness, asset.faces[f].normal.dot(normal));
    }
    if (likeness > best) {
      best = likeness;
      across = candidate;
    }
  }
  if (across == kNoElement) return kNothingAcross;
  unsigned places = 0;
  for (unsigned c = 0; c < 3; ++c) places |= placeOf(*v[c], across) << (4 * c);
  return std::uint16_t(places);
}

// Both sides coincide when at all three corners the copies of both elements follow the same set.
bool CellMesh::isJoined(std::size_t triangle, std::span<const CellMask> masks) const {
  if (m_placesAcross[triangle] == kNothingAcross) return false;
  for (unsigned c = 0; c < 3; ++c) {
    const std::uint32_t packed = m_corners[m_triangles[triangle][c]].vertexAndOwner;
    const CellMask mask = masks[packed / 4];
    const unsigned across = m_placesAcross[triangle] >> (4 * c) & 15u;
    if (maskOf(mask, packed % 4) != maskOf(mask, across)) return false;
  }
  return true;
}

void CellMesh::visible(std::span<const CellMask> masks, std::span<const ElementPose> poses,
                       std::vector<std::array<std::uint32_t, 3>>& out) const {
  out.clear();
  for (std::size_t t = 0; t < m_triangles.size(); ++t) {
    if (poses[m_owners[t]].alive > 0 && !isJoined(t, masks)) out.push_back(m_triangles[t]);
  }
}

}  // namespace rubble::render
