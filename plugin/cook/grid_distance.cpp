#include "cook/grid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cook/box_distance.h"

namespace rubble::cooking {
namespace {

constexpr double kMostNodes = 1 << 24;  // 64 MB of values
constexpr int kMargin = 2;              // nodes around the solid, so that gradients exist there too
constexpr int kSweepRounds = 2;         // of eight directions each; a third changes nothing that matters here

// Whether the line (y, z) along x passes on the left of the edge a-b, in the yz plane. Both triangles at the
// edge ask with the same order of ends and so get the same answer: no ray slips between them.
bool edgeCrossed(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double y, double z) {
  if ((a.z() > z) == (b.z() > z)) return false;
  return y < a.y() + (z - a.z()) / (b.z() - a.z()) * (b.y() - a.y());
}

}  // namespace

std::unique_ptr<SignedDistance> signedDistance(const CheckedMesh& mesh, double radius) {
  constexpr double kSpacing = 0.5;  // [radii] measured: errors of 0.07 to 0.25 r near edges of the surface
  if (BoxDistance::isBox(mesh)) return std::make_unique<BoxDistance>(mesh.bounds);
  return std::make_unique<GridDistance>(mesh, kSpacing * radius);
}

GridDistance::GridDistance(const CheckedMesh& mesh, double wantedSpacing) : m_mesh(mesh), m_tree(mesh) {
  chooseNodes(wantedSpacing);
  m_values.assign(std::size_t(m_count[0]) * std::size_t(m_count[1]) * std::size_t(m_count[2]),
                  std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> nearest(m_values.size(), kNoElement);
  measureBand(nearest);
  for (int round = 0; round < kSweepRounds; ++round)
    for (const int z : {1, -1})
      for (const int y : {1, -1})
        for (const int x : {1, -1}) sweep(nearest, {x, y, z});
  applySigns();
}

void GridDistance::chooseNodes(double wantedSpacing) {
  const Eigen::Vector3d sizes = m_mesh.bounds.sizes();
  const auto nodes = [&sizes](double spacing) {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) product *= std::ceil(sizes[axis] / spacing) + 1 + 2 * kMargin;
    return product;
  };
  // No wider than a tenth of the solid: few large elements still need to feel its shape.
  m_spacing = std::min(wantedSpacing, sizes.maxCoeff() / 10);
  constexpr double kWiden = 1.1;
  while (nodes(m_spacing) > kMostNodes) m_spacing *= kWiden;
  for (int axis = 0; axis < 3; ++axis)
    m_count[std::size_t(axis)] = int(std::ceil(sizes[axis] / m_spacing)) + 1 + 2 * kMargin;
  m_origin = m_mesh.bounds.min() - Eigen::Vector3d::Constant(kMargin * m_spacing);
}

double GridDistance::distanceTo(std::uint32_t triangle, const Eigen::Vector3d& from) const {
  const auto& [a, b, c] = m_mesh.triangles[triangle];
  return (closestOnTriangle(from, m_mesh.vertices[a], m_mesh.vertices[b], m_mesh.vertices[c]) - from).norm();
}

// Exact distances at the nodes around each triangle.
void GridDistance::measureBand(std::vector<std::uint32_t>& nearest) {
  for (std::uint32_t t = 0; t < m_mesh.triangles.size(); ++t) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t v : m_mesh.triangles[t]) box.extend((m_mesh.vertices[v] - m_origin) / m_spacing);
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = Eigen::Index(axis);
      low[axis] = std::max(int(std::floor(box.min()[a])), 0);
      high[axis] = std::min(int(std::ceil(box.max()[a])), m_count[axis] - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x) {
          const auto distance = float(distanceTo(t, place(x, y, z)));
          const std::size_t at = node(x, y, z);
          if (distance >= m_values[at]) continue;
          m_values[at] = distance;
          nearest[at] = t;
        }
  }
}

// Hands the nearest triangle on to the nodes behind, as seen in one of the eight diagonal directions.
void GridDistance::sweep(std::vector<std::uint32_t>& nearest, std::array<int, 3> direction) {
  const auto begin = [&](std::size_t axis) { return direction[axis] > 0 ? 0 : m_count[axis] - 1; };
  const auto inside = [&](std::size_t axis, int i) { return i >= 0 && i < m_count[axis]; };
  for (int z = begin(2); inside(2, z); z += direction[2])
    for (int y = begin(1); inside(1, y); y += direction[1])
      for (int x = begin(0); inside(0, x); x += direction[0]) {
        const std::size_t at = node(x, y, z);
        const auto consider = [&](std::size_t from) {
          const std::uint32_t triangle = nearest[from];
          if (triangle == kNoElement || triangle == nearest[at]) return;
          const auto distance = float(distanceTo(triangle, place(x, y, z)));
          if (distance >= m_values[at]) return;
          m_values[at] = distance;
          nearest[at] = triangle;
        };
        if (inside(0, x - direction[0])) consider(node(x - direction[0], y, z));
        if (inside(1, y - direction[1])) consider(node(x, y - direction[1], z));
        if (inside(2, z - direction[2])) consider(node(x, y, z - direction[2]));
      }
}

bool GridDistance::crossesLine(std::uint32_t triangle, double y, double z) const {
  int crossed = 0;
  for (const std::uint32_t edge : m_mesh.triangleEdges[triangle])
    crossed +=
        edgeCrossed(m_mesh.vertices[m_mesh.edges[edge][0]], m_mesh.vertices[m_mesh.edges[edge][1]], y, z) ? 1
                                                                                                          : 0;
  return crossed % 2 != 0;
}

// Parity of the surface's crossings along x.
void GridDistance::applySigns() {
  std::vector<std::uint8_t> flips(m_values.size(), 0);
  for (std::uint32_t t = 0; t < m_mesh.triangles.size(); ++t) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t v : m_mesh.triangles[t]) box.extend(m_mesh.vertices[v]);
    const Eigen::Vector3d low = (box.min() - m_origin) / m_spacing;
    const Eigen::Vector3d high = (box.max() - m_origin) / m_spacing;
    const Eigen::Vector3d& normal = m_mesh.normals[t];
    const Eigen::Vector3d& corner = m_mesh.vertices[m_mesh.triangles[t][0]];
    for (int z = int(low.z()); z <= int(high.z()) + 1 && z < m_count[2]; ++z)
      for (int y = int(low.y()); y <= int(high.y()) + 1 && y < m_count[1]; ++y) {
        const Eigen::Vector3d line = place(0, y, z);
        if (!crossesLine(t, line.y(), line.z())) continue;
        // Where the line meets the plane; a triangle edge-on to it answers with its middle.
        const double slope = normal.y() * (line.y() - corner.y()) + normal.z() * (line.z() - corner.z());
        double x = normal.x() != 0 ? corner.x() - slope / normal.x() : box.center().x();
        x = std::clamp(x, box.min().x(), box.max().x());
        const int at = std::clamp(int(std::ceil((x - m_origin.x()) / m_spacing)), 0, m_count[0] - 1);
        flips[node(at, y, z)] ^= 1u;
      }
  }
  for (int z = 0; z < m_count[2]; ++z)
    for (int y = 0; y < m_count[1]; ++y) {
      unsigned inside = 0;
      for (int x = 0; x < m_count[0]; ++x) {
        const std::size_t at = node(x, y, z);
        inside ^= flips[at];
        if (inside != 0) m_values[at] = -m_values[at];
      }
    }
}

Distance GridDistance::fast(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d scaled = (p - m_origin) / m_spacing;
  std::array<int, 3> cell{};
  std::array<double, 3> share{};
  double beyond = 0;  // squared distance to the grid, in spacings
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double wanted = scaled[Eigen::Index(axis)];
    const double kept = std::clamp(wanted, 0.0, double(m_count[axis] - 1));
    beyond += (wanted - kept) * (wanted - kept);
    cell[axis] = std::min(int(kept), m_count[axis] - 2);
    share[axis] = kept - cell[axis];
  }
  Distance result{0, Eigen::Vector3d::Zero()};
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> bit = {corner & 1, (corner >> 1) & 1, (corner >> 2) & 1};
    const double value = double(m_values[node(cell[0] + bit[0], cell[1] + bit[1], cell[2] + bit[2])]);
    std::array<double, 3> weight{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      weight[axis] = bit[axis] != 0 ? share[axis] : 1 - share[axis];
    result.value += weight[0] * weight[1] * weight[2] * value;
    result.gradient.x() += (bit[0] != 0 ? value : -value) * weight[1] * weight[2];
    result.gradient.y() += (bit[1] != 0 ? value : -value) * weight[0] * weight[2];
    result.gradient.z() += (bit[2] != 0 ? value : -value) * weight[0] * weight[1];
  }
  result.value += std::sqrt(beyond) * m_spacing;
  const double slope = result.gradient.norm();
  result.gradient = slope > 0 ? Eigen::Vector3d(result.gradient / slope) : Eigen::Vector3d::UnitZ();
  return result;
}

Distance GridDistance::exact(const Eigen::Vector3d& p) const {
  const TriangleTree::Closest closest = m_tree.closest(p);
  const Distance sampled = fast(p);
  const double distance = std::sqrt(closest.squaredDistance);
  // Far from the surface the samples know the side; close by, the triangle does.
  const Eigen::Vector3d away = p - closest.point;
  const double side =
      std::abs(sampled.value) > m_spacing ? sampled.value : away.dot(m_mesh.normals[closest.triangle]);
  if (distance == 0) return {0, m_mesh.normals[closest.triangle]};
  return side < 0 ? Distance{-distance, -away / distance} : Distance{distance, away / distance};
}

}  // namespace rubble::cooking
