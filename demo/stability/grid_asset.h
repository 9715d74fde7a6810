// An asset made by hand, for tests and generated cases: a block of n x m x k cubes. Every number in it is
// exact, so tests can compare with closed forms.
//
//   element (i, j, l) has index i + n (j + m l), its centre at origin + h (i + 1/2, j + 1/2, l + 1/2)
//
// Springs are the shared faces (area h^2), every cell has six faces and twelve triangles, r = h / 2. A point
// of the lattice inside the block is shared by eight cells, but a CellVertex names at most four (cells of a
// real asset are in general position). Such a point is split into copies at one place: for each axis c one
// copy for the four cells below it along c and one for the four above. A face that looks along axis a uses
// the copies of axis c = (a + 2) mod 3: their four cells lie around the point in the plane of a and (a + 1)
// mod 3, so that both cells of the face are among them and the face closes exactly. Points on the block's
// surface have at most four cells and are not split: the surface of a bent block shows no gaps.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "rubble/asset.h"

namespace rubble::stability {

struct GridAssetDef {
  std::array<int, 3> cubes{2, 2, 2};                 ///< along x, y, z; each at least 1
  double edge = 1;                                   ///< h, of one cube [m]
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< lowest corner of the block [m]
  bool anchored = false;                             ///< ties the lowest layer (y) to the world
};

class GridAssetBuilder {
 public:
  explicit GridAssetBuilder(const GridAssetDef& def) : m_def(def) {
    addElements();
    for (std::uint32_t e = 0; e < m_asset.positions.size(); ++e) addCell(e);
  }
  Asset take() { return std::move(m_asset); }

 private:
  using Point = std::array<int, 3>;

  Point place(std::uint32_t element) const {
    const auto n = std::uint32_t(m_def.cubes[0]), m = std::uint32_t(m_def.cubes[1]);
    return {int(element % n), int(element / n % m), int(element / (n * m))};
  }
  std::uint32_t elementAt(const Point& p) const {
    for (unsigned a = 0; a < 3; ++a) {
      if (p[a] < 0 || p[a] >= m_def.cubes[a]) return kNoElement;
    }
    return std::uint32_t(p[0] + m_def.cubes[0] * (p[1] + m_def.cubes[1] * p[2]));
  }
  static Point moved(Point p, unsigned axis, int by) {
    p[axis] += by;
    return p;
  }
  Eigen::Vector3d position(const Eigen::Vector3d& inCubes) const {
    return m_def.origin + m_def.edge * inCubes;
  }

  void addElements() {
    const double h = m_def.edge;
    const auto count = std::uint32_t(m_def.cubes[0] * m_def.cubes[1] * m_def.cubes[2]);
    m_asset.radius = h / 2;
    for (std::uint32_t e = 0; e < count; ++e) {
      const Point p = place(e);
      m_asset.positions.push_back(position(Eigen::Vector3d(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5)));
      m_asset.volumes.push_back(h * h * h);
      m_asset.gyrations.push_back(h * h / 6);  // a cube's inertia is m h^2 / 6 about every axis
      for (unsigned a = 0; a < 3; ++a) {
        const std::uint32_t next = elementAt(moved(p, a, 1));
        if (next != kNoElement) m_asset.springs.push_back({e, next, h * h});
      }
      if (m_def.anchored && p[1] == 0) {
        m_asset.anchors.push_back({e, h * h, position(Eigen::Vector3d(p[0] + 0.5, 0, p[2] + 0.5))});
      }
    }
  }

  // The cells around a lattice point; `axis` < 3 keeps those on one side of it along that axis.
  std::vector<std::uint32_t> cellsAround(const Point& point, unsigned axis, int side) const {
    std::vector<std::uint32_t> cells;
    for (int corner = 0; corner < 8; ++corner) {
      Point p = point;
      for (unsigned a = 0; a < 3; ++a) p[a] -= corner >> a & 1;
      if (axis < 3 && p[axis] != side) continue;
      const std::uint32_t e = elementAt(p);
      if (e != kNoElement) cells.push_back(e);
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  }

  std::uint32_t vertexAt(const Point& point, std::uint32_t element, unsigned faceAxis) {
    constexpr unsigned kWhole = 3;  // not split
    unsigned axis = kWhole;
    int side = 0;
    std::vector<std::uint32_t> cells = cellsAround(point, axis, side);
    if (cells.size() > 4) {
      axis = (faceAxis + 2) % 3;
      side = place(element)[axis];
      cells = cellsAround(point, axis, side);
    }
    const auto [it, isNew] = m_vertexOf.try_emplace({point[0], point[1], point[2], int(axis), side},
                                                    std::uint32_t(m_asset.vertices.size()));
    if (isNew) {
      CellVertex vertex{position(Eigen::Vector3d(point[0], point[1], point[2])).cast<float>(),
                        {kNoElement, kNoElement, kNoElement, kNoElement}};
      std::copy(cells.begin(), cells.end(), vertex.elements.begin());
      m_asset.vertices.push_back(vertex);
    }
    return it->second;
  }

  void addFace(std::uint32_t element, unsigned axis, int side) {
    const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Point p = place(element);
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    normal[axis] = side > 0 ? 1.f : -1.f;
    const auto first = std::uint32_t(m_asset.corners.size());
    // Counter-clockwise about +axis; the other way round for the face that looks along -axis.
    constexpr std::array<std::array<int, 2>, 4> kRound{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (unsigned c = 0; c < 4; ++c) {
      const auto& at = kRound[side > 0 ? c : 3 - c];
      Point point = moved(p, axis, side > 0 ? 1 : 0);
      point[u] += at[0];
      point[v] += at[1];
      m_asset.corners.push_back({vertexAt(point, element, axis), element, normal});
    }
    m_asset.triangles.push_back({first, first + 1, first + 2});
    m_asset.triangles.push_back({first, first + 2, first + 3});
    Eigen::Vector3d centre(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5);
    centre[axis] += 0.5 * side;
    m_asset.faces.push_back({elementAt(moved(p, axis, side)), float(m_def.edge * m_def.edge), normal,
                             position(centre).cast<float>()});
  }

  void addCell(std::uint32_t element) {
    Cell cell{std::uint32_t(m_asset.triangles.size()), 0, 0, std::uint32_t(m_asset.faces.size()), 6};
    for (const bool inner : {false, true}) {  // outer triangles stand first
      for (unsigned axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
          const bool faceIsInner = elementAt(moved(place(element), axis, side)) != kNoElement;
          if (faceIsInner != inner) continue;
          addFace(element, axis, side);
          (inner ? cell.innerTriangles : cell.outerTriangles) += 2;
        }
      }
    }
    m_asset.cells.push_back(cell);
  }

  GridAssetDef m_def;
  Asset m_asset;
  std::map<std::array<int, 5>, std::uint32_t> m_vertexOf;
};

inline Asset gridAsset(const GridAssetDef& def) {
  return GridAssetBuilder(def).take();
}

}  // namespace rubble::stability
