#include "base/asset_cell_walk.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace rubble::base {
namespace {

// A normal is stored in floats; this is a few hundred times their rounding, and far from any wrong normal.
constexpr float kUnitTolerance = 1e-4f;

// A square so near to 1 has a root within the tolerance, and needs none to be taken.
bool isSurelyUnit(const Eigen::Vector3f& normal) {
  return std::abs(normal.squaredNorm() - 1.0f) <= 1.9f * kUnitTolerance;
}

bool isOf(const CellVertex& vertex, std::uint32_t element) {
  const auto& e = vertex.elements;
  return (e[0] == element) | (e[1] == element) | (e[2] == element) | (e[3] == element);
}

}  // namespace

void checkUnit(const Eigen::Vector3f& normal, const char* array, std::size_t at) {
  if (isSurelyUnit(normal)) return;
  const float length = normal.norm();
  if (!(std::abs(length - 1.0f) <= kUnitTolerance))
    refuseAsset(array, '[', at, "].normal has length ", length, "; allowed: 1");
}

void CellWalk::checkCorner(std::uint32_t c) {
  const CellCorner& corner = m_asset.corners[c];
  if (corner.vertex >= m_asset.vertices.size())
    refuseAsset("corners[", c, "].vertex is ", corner.vertex, "; allowed: 0 to ",
                m_asset.vertices.size() - 1);
  if (!isOf(m_asset.vertices[corner.vertex], corner.element) || corner.element == kNoElement)
    refuseAsset("corners[", c, "].element is ", corner.element,
                "; allowed: one of those of its vertex, vertices[", corner.vertex, ']');
  checkUnit(corner.normal, "corners", c);
  m_isUsed[corner.vertex] = 1;
}

void CellWalk::gatherCorners(std::uint32_t cell) {
  const Eigen::Vector3d origin = m_asset.positions[cell];
  const std::span corners(m_asset.corners);
  const std::span vertices(m_asset.vertices);
  std::uint8_t* const isUsed = m_isUsed.data();
  std::size_t room = m_places.size();
  std::uint32_t c = m_first = m_end;
  for (; c < corners.size() && corners[c].element == cell; ++c) {
    const std::uint32_t vertex = corners[c].vertex;
    if (vertex >= vertices.size() || !isOf(vertices[vertex], cell) || !isSurelyUnit(corners[c].normal))
      checkCorner(c);
    isUsed[vertex] = 1;
    if (c - m_first == room) m_places.resize(room = 2 * room + 64);
    m_places[c - m_first] = vertices[vertex].position.cast<double>() - origin;
  }
  m_end = c;
}

// Of a corner that is not among those: it may still be of the cell.
Eigen::Vector3d CellWalk::placeOfOther(std::uint32_t corner, std::uint32_t cell, std::uint32_t triangle) {
  if (corner >= m_asset.corners.size() || m_asset.corners[corner].element != cell)
    refuseAsset("triangles[", triangle, "] of cell ", cell, " names corner ", corner,
                "; allowed: corners of that cell");
  checkCorner(corner);
  return m_asset.vertices[m_asset.corners[corner].vertex].position.cast<double>() - m_asset.positions[cell];
}

CellShape CellWalk::enter(std::uint32_t i) {
  gatherCorners(i);
  const Cell& cell = m_asset.cells[i];
  const std::uint32_t count = cell.outerTriangles + cell.innerTriangles;
  const std::uint32_t first = m_first, known = m_end - m_first;
  const Eigen::Vector3d* places = m_places.data();
  Eigen::AlignedBox3d box;
  double volume = 0, outerArea = 0, innerArea = 0;
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<Eigen::Vector3d, 3> others;
    std::array<const Eigen::Vector3d*, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t corner = m_asset.triangles[cell.firstTriangle + t][c];
      p[c] = corner - first < known ? &places[corner - first]
                                    : &(others[c] = placeOfOther(corner, i, cell.firstTriangle + t));
    }
    box.min() = box.min().cwiseMin(p[0]->cwiseMin(*p[1]).cwiseMin(*p[2]));
    box.max() = box.max().cwiseMax(p[0]->cwiseMax(*p[1]).cwiseMax(*p[2]));
    const Eigen::Vector3d across = (*p[1] - *p[0]).cross(*p[2] - *p[0]);
    volume += p[0]->dot(across);
    (t < cell.outerTriangles ? outerArea : innerArea) += across.norm();
  }
  CellShape shape;
  shape.box = box;
  shape.volume = volume / 6;
  shape.outerArea = outerArea / 2;
  shape.innerArea = innerArea / 2;
  // Moving the vertices of a triangle by e turns edges l into l + 2 e at most, which adds 2 e (l + e) to its
  // area; a surface that moves by e sweeps e times its area.
  const double e = m_rounding;
  shape.areaSlack = 2 * e * double(count) * (shape.box.diagonal().norm() + e);
  shape.volumeSlack = e * (shape.outerArea + shape.innerArea + shape.areaSlack);
  const Eigen::Vector3d origin = m_asset.positions[i], margin = Eigen::Vector3d::Constant(e);
  shape.box = Eigen::AlignedBox3d(shape.box.min() + origin - margin, shape.box.max() + origin + margin);
  return shape;
}

void CellWalk::continueFrom(const CellWalk& next) {
  for (std::size_t v = 0; v < m_isUsed.size(); ++v) m_isUsed[v] |= next.m_isUsed[v];
  m_end = next.m_end;
}

void CellWalk::finish() {
  for (; m_end < m_asset.corners.size(); ++m_end) checkCorner(m_end);
  const auto stray = std::find(m_isUsed.begin(), m_isUsed.end(), 0);
  if (stray != m_isUsed.end())
    refuseAsset("vertices[", stray - m_isUsed.begin(), "] is in no corner; allowed: vertices of cells");
}

}  // namespace rubble::base
