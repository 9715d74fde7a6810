#include "edem/cell_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubble::edem {
namespace {

// Triangles of the solid's surface are one face when their normals agree to this and their planes to this
// many spacings: what the floats of an asset hold.
constexpr double kFlat = 1e-4;
// Vertices nearer than this many spacings are one; areas below its square are none.
constexpr double kSame = 1e-6;

// A face while its triangles are gathered.
struct Gathered {
  std::uint32_t neighbour;
  Eigen::Vector3d normal;
  double offset;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

class Builder {
 public:
  explicit Builder(const Asset& asset) : m_asset(asset), m_spacing(asset.spacing()) {
    m_out.unit = m_spacing * m_spacing;
    m_out.firstVertex.push_back(0);
    m_out.firstFace.push_back(0);
    for (std::uint32_t i = 0; i < asset.elementCount(); ++i) addCell(i);
  }
  CellFaces take() { return std::move(m_out); }

 private:
  std::uint32_t vertexOf(std::uint32_t element, std::uint32_t corner) {
    const Eigen::Vector3d at =
        m_asset.vertices[m_asset.corners[corner].vertex].position.cast<double>() - m_asset.positions[element];
    for (std::uint32_t v = m_out.firstVertex[element]; v < m_out.vertices.size(); ++v)
      if ((m_out.vertices[v] - at).squaredNorm() < kSame * kSame * m_out.unit) return v;
    m_out.vertices.push_back(at);
    return std::uint32_t(m_out.vertices.size() - 1);
  }

  // The inner face of the cell whose plane holds a triangle best.
  std::uint32_t neighbourAt(std::uint32_t element, const Eigen::Vector3d& middle,
                            const Eigen::Vector3d& normal) const {
    std::uint32_t best = kNoElement;
    double least = std::numeric_limits<double>::infinity();
    for (const CellFace& face : m_asset.cellFaces(element)) {
      if (face.neighbour == kNoElement) continue;
      const Eigen::Vector3d n = face.normal.cast<double>();
      const Eigen::Vector3d centre = face.centroid.cast<double>() - m_asset.positions[element];
      const double off = 1 - n.dot(normal) + std::abs(n.dot(middle - centre)) / m_spacing;
      if (off < least) {
        least = off;
        best = face.neighbour;
      }
    }
    return best;
  }

  void gather(std::uint32_t element, std::uint32_t triangle, bool outer, std::vector<Gathered>& faces) {
    std::array<std::uint32_t, 3> corners;
    for (unsigned c = 0; c < 3; ++c) corners[c] = vertexOf(element, m_asset.triangles[triangle][c]);
    const Eigen::Vector3d &a = m_out.vertices[corners[0]], &b = m_out.vertices[corners[1]],
                          &c = m_out.vertices[corners[2]];
    const Eigen::Vector3d twice = (b - a).cross(c - a);
    if (twice.norm() < 2 * kSame * kSame * m_out.unit) return;
    const Eigen::Vector3d normal = twice.normalized();
    const double offset = normal.dot(a + b + c) / 3;
    const std::uint32_t neighbour = outer ? kNoElement : neighbourAt(element, (a + b + c) / 3, normal);
    const auto same = [&](const Gathered& f) {
      if (f.neighbour != neighbour) return false;
      return !outer || (1 - f.normal.dot(normal) < kFlat && std::abs(f.offset - offset) < kFlat * m_spacing);
    };
    auto face = std::find_if(faces.begin(), faces.end(), same);
    if (face == faces.end()) face = faces.insert(face, {neighbour, normal, offset, {}});
    face->triangles.push_back(corners);
  }

  std::uint32_t springOf(std::uint32_t a, std::uint32_t b) const {
    if (b == kNoElement) return CellFaces::kNoSpring;
    const std::pair<std::uint32_t, std::uint32_t> wanted(std::min(a, b), std::max(a, b));
    const auto name = [](const AssetSpring& s) { return std::pair(s.first, s.second); };
    const auto found = std::lower_bound(m_asset.springs.begin(), m_asset.springs.end(), wanted,
                                        [&](const AssetSpring& s, const auto& w) { return name(s) < w; });
    if (found == m_asset.springs.end() || name(*found) != wanted) return CellFaces::kNoSpring;
    return std::uint32_t(found - m_asset.springs.begin());
  }

  void addCell(std::uint32_t element) {
    const Cell& cell = m_asset.cells[element];
    std::vector<Gathered> faces;
    for (std::uint32_t t = 0; t < cell.outerTriangles + cell.innerTriangles; ++t)
      gather(element, cell.firstTriangle + t, t < cell.outerTriangles, faces);
    double reach = 0, nearest = m_asset.radius;
    for (std::uint32_t v = m_out.firstVertex[element]; v < m_out.vertices.size(); ++v)
      reach = std::max(reach, m_out.vertices[v].norm());
    for (const Gathered& f : faces) {
      m_out.faces.push_back({f.neighbour, springOf(element, f.neighbour),
                             std::uint32_t(m_out.triangles.size()), std::uint32_t(f.triangles.size()),
                             f.normal, f.offset});
      m_out.triangles.insert(m_out.triangles.end(), f.triangles.begin(), f.triangles.end());
      nearest = std::min(nearest, f.offset);
    }
    m_out.firstVertex.push_back(std::uint32_t(m_out.vertices.size()));
    m_out.firstFace.push_back(std::uint32_t(m_out.faces.size()));
    m_out.reach.push_back(reach);
    // Half a radius, or less in a flat cell: it never comes out of the faces.
    m_out.core.push_back(0.5 * std::max(0.0, nearest));
    m_out.largestReach = std::max(m_out.largestReach, reach);
  }

  const Asset& m_asset;
  double m_spacing;
  CellFaces m_out;
};

// Vector areas of the exposed faces at the vertices of a cell.
void sumAreas(const CellFaces& cells, std::uint32_t element, Exposure& exposure) {
  const std::uint32_t begin = cells.firstVertex[element], end = cells.firstVertex[element + 1];
  std::vector<Eigen::Vector3d> areas(end - begin, Eigen::Vector3d::Zero());
  for (std::uint32_t f = cells.firstFace[element]; f < cells.firstFace[element + 1]; ++f) {
    if (!exposure.faces[f]) continue;
    const CellFaces::Face& face = cells.faces[f];
    for (std::uint32_t t = 0; t < face.triangleCount; ++t) {
      const auto& corners = cells.triangles[face.firstTriangle + t];
      const Eigen::Vector3d& a = cells.vertices[corners[0]];
      const Eigen::Vector3d sixth =
          (cells.vertices[corners[1]] - a).cross(cells.vertices[corners[2]] - a) / 6;
      for (const std::uint32_t v : corners) areas[v - begin] += sixth;
    }
  }
  std::uint32_t count = 0;
  double area = 0, leverArea = 0;
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  for (std::uint32_t v = begin; v < end; ++v) {
    const double size = areas[v - begin].norm();
    if (!(size > kSame * cells.unit)) continue;
    exposure.points[begin + count++] = {cells.vertices[v], areas[v - begin]};
    area += size;
    leverArea += size * cells.vertices[v].squaredNorm();
    all += areas[v - begin];
  }
  exposure.count[element] = count;
  exposure.area[element] = area;
  exposure.leverArea[element] = leverArea;
  // Sum of max(0, -a . n) = (sum |a . n| - n . sum a) / 2.
  exposure.facing[element] = 0.5 * (area + all.norm());
}

// Exposes what may be now; true if that is more than before.
bool expose(const CellFaces& cells, std::span<const std::uint8_t> intact, std::uint32_t element,
            Exposure& exposure) {
  bool more = false;
  for (std::uint32_t f = cells.firstFace[element]; f < cells.firstFace[element + 1]; ++f) {
    const CellFaces::Face& face = cells.faces[f];
    if (exposure.faces[f]) continue;
    const bool open = face.spring != CellFaces::kNoSpring
                          ? !intact[face.spring]
                          : exposure.torn[element] || exposure.torn[face.neighbour];
    if (!open) continue;
    exposure.faces[f] = 1;
    more = true;
  }
  if (more) sumAreas(cells, element, exposure);
  return more;
}

}  // namespace

CellFaces makeCellFaces(const Asset& asset) {
  return Builder(asset).take();
}

Exposure exposeOuter(const CellFaces& cells) {
  const std::size_t n = cells.reach.size();
  Exposure exposure;
  exposure.torn.assign(n, 0);
  exposure.points.resize(cells.vertices.size());
  exposure.count.resize(n);
  exposure.area.resize(n);
  exposure.leverArea.resize(n);
  exposure.facing.resize(n);
  for (const CellFaces::Face& face : cells.faces) exposure.faces.push_back(face.neighbour == kNoElement);
  for (std::uint32_t i = 0; i < n; ++i) sumAreas(cells, i, exposure);
  return exposure;
}

void exposeBroken(const CellFaces& cells, std::span<const std::uint8_t> intact, std::uint32_t first,
                  std::uint32_t second, Exposure& exposure) {
  exposure.torn[first] = exposure.torn[second] = 1;
  for (const std::uint32_t i : {first, second}) {
    expose(cells, intact, i, exposure);
    for (const CellFaces::Face& face : cells.of(i))
      if (face.neighbour != kNoElement && face.spring == CellFaces::kNoSpring)
        expose(cells, intact, face.neighbour, exposure);
  }
}

}  // namespace rubble::edem
