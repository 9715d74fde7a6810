// The edges of all openings cut the slab into a grid of blocks, of which those in an opening are left out.
// Blocks share their corners, so the surface is closed; it has more triangles than it needs, and the cook
// joins coplanar ones.
#include "demo/slab_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace rubble::demo {
namespace {

constexpr double kApart = 1e-3;     // [larger edge of the slab] between openings, and to the edges
constexpr double kRounding = 1e-6;  // [larger edge]; ends this near to an edge of the slab are at it

// From `low` to `high` along one axis.
struct Span {
  double low, high;
};

double larger(const Eigen::Vector3d& size) {
  return std::max(size.x(), size.y());
}

Span atEdges(double start, double length, double full, double rounding) {
  Span span{start, start + length};
  if (span.low < rounding) span.low = 0;
  if (span.high > full - rounding) span.high = full;
  return span;
}

Span across(const Opening& o, const Eigen::Vector3d& size) {
  return atEdges(o.left, o.width, size.x(), kRounding * larger(size));
}
Span upright(const Opening& o, const Eigen::Vector3d& size) {
  return atEdges(o.bottom, o.height, size.y(), kRounding * larger(size));
}

bool isNearEdge(const Span& span, double full, double apart) {
  return (span.low > 0 && span.low < apart) || (span.high < full && full - span.high < apart);
}

bool isWhole(const Span& span, double full) {
  return span.low <= 0 && span.high >= full;
}

// Below 0 where they overlap.
double gap(const Span& a, const Span& b) {
  return std::max(a.low - b.high, b.low - a.high);
}

class SlabBuilder {
 public:
  SlabBuilder(const Eigen::Vector3d& size, const std::vector<Opening>& openings)
      : m_size(size), m_x{0, size.x()}, m_y{0, size.y()} {
    for (const Opening& opening : openings) {
      m_holes.emplace_back(across(opening, size), upright(opening, size));
      for (const double x : {m_holes.back().first.low, m_holes.back().first.high}) m_x.push_back(x);
      for (const double y : {m_holes.back().second.low, m_holes.back().second.high}) m_y.push_back(y);
    }
    for (std::vector<double>* lines : {&m_x, &m_y}) {
      std::sort(lines->begin(), lines->end());
      lines->erase(std::unique(lines->begin(), lines->end()), lines->end());
    }
    for (int i = 0; i + 1 < int(m_x.size()); ++i)
      for (int j = 0; j + 1 < int(m_y.size()); ++j)
        if (isFilled(i, j)) addBlock(i, j);
  }
  SurfaceMesh take() && { return std::move(m_mesh); }

 private:
  bool isFilled(int i, int j) const {
    if (i < 0 || j < 0 || i + 1 >= int(m_x.size()) || j + 1 >= int(m_y.size())) return false;
    const auto column = std::size_t(i), row = std::size_t(j);
    const double x = (m_x[column] + m_x[column + 1]) / 2, y = (m_y[row] + m_y[row + 1]) / 2;
    const auto holds = [](const Span& span, double at) { return span.low < at && at < span.high; };
    return std::none_of(m_holes.begin(), m_holes.end(),
                        [&](const auto& hole) { return holds(hole.first, x) && holds(hole.second, y); });
  }
  // k is 0 at the back (-z) and 1 at the front.
  std::uint32_t vertex(int i, int j, int k) {
    const auto [entry, isNew] = m_vertices.try_emplace({i, j, k}, std::uint32_t(m_mesh.vertices.size()));
    if (isNew)
      m_mesh.vertices.emplace_back(m_x[std::size_t(i)] - m_size.x() / 2, m_y[std::size_t(j)] - m_size.y() / 2,
                                   (k - 0.5) * m_size.z());
    return entry->second;
  }
  void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    m_mesh.triangles.push_back({a, b, c});
    m_mesh.triangles.push_back({a, c, d});
  }
  void addBlock(int i, int j) {
    const auto at = [&](int di, int dj, int k) { return vertex(i + di, j + dj, k); };
    addQuad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    addQuad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    if (!isFilled(i - 1, j)) addQuad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    if (!isFilled(i + 1, j)) addQuad(at(1, 0, 1), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1));
    if (!isFilled(i, j - 1)) addQuad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    if (!isFilled(i, j + 1)) addQuad(at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0));
  }

  Eigen::Vector3d m_size;
  std::vector<double> m_x, m_y;  // lines of the grid, from the lower left corner [m]
  std::vector<std::pair<Span, Span>> m_holes;
  std::map<std::tuple<int, int, int>, std::uint32_t> m_vertices;
  SurfaceMesh m_mesh;
};

}  // namespace

std::string wrongOpening(const Eigen::Vector3d& size, const std::vector<Opening>& openings) {
  const double apart = kApart * larger(size), rounding = kRounding * larger(size);
  const auto name = [](std::size_t i) { return "openings." + std::to_string(i); };
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const Opening& o = openings[i];
    if (o.left + o.width > size.x() + rounding || o.bottom + o.height > size.y() + rounding)
      return name(i) + " must end within the slab";
    const Span x = across(o, size), y = upright(o, size);
    if (isWhole(x, size.x()) || isWhole(y, size.y())) return name(i) + " must not cut the slab in two";
    if (isNearEdge(x, size.x(), apart) || isNearEdge(y, size.y(), apart))
      return name(i) + " must end at an edge of the slab or a thousandth of it before";
    for (std::size_t k = 0; k < i; ++k)
      if (std::max(gap(x, across(openings[k], size)), gap(y, upright(openings[k], size))) < apart)
        return name(i) + " must be a thousandth of the slab away from " + name(k);
  }
  return "";
}

SurfaceMesh slabMesh(const Eigen::Vector3d& size, const std::vector<Opening>& openings) {
  return SlabBuilder(size, openings).take();
}

}  // namespace rubble::demo
