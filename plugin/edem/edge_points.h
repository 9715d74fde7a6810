// Edges of boxes and hulls as rows of corners: what lies across a cell without a corner in it presses it by
// the points of its edges.
#pragma once

#include <array>
#include <cstdint>

#include "edem/cell_faces.h"
#include "edem/rigid_proxy.h"

namespace rubble::edem {

/// Points of a sharp edge at dyadic fractions of it, h / 2 apart at most. Those of two rows on one edge have
/// the same names where they are at the same place. Without its ends, which are corners.
class EdgeRow {
 public:
  /// From `from` along `way`; `sharpness`: see Hull::Edge; `h`: edge of the face that k_n is of [m].
  EdgeRow(const Eigen::Vector3d& from, const Eigen::Vector3d& way, double sharpness, double h);

  /// Those from `first` to before `last`.
  struct Range {
    std::uint32_t first = 1, last = 1;
    std::uint32_t count() const { return last - first; }
  };
  /// Those that may be nearer than `reach` to a point, in closed form.
  Range within(const Eigen::Vector3d& point, double reach) const;
  /// As many as may be in a body of this size at once.
  std::uint32_t most(double size) const;
  Eigen::Vector3d at(std::uint32_t place) const { return m_from + double(place) / double(m_count) * m_way; }
  std::uint32_t nameOf(std::uint32_t place) const { return place << (kLevels - m_level); }
  /// Stiffness of each over k_n: on a right edge, half of one along h, since two edges of what is narrow
  /// bear.
  double weight() const { return m_weight; }

 private:
  static constexpr std::uint32_t kLevels = 24;  // a million h
  Eigen::Vector3d m_from, m_way;
  double m_weight;
  std::uint32_t m_level = 0, m_count = 1;
};

inline bool hasEdges(const Collider& part) {
  return part.kind == Collider::Kind::Box || part.kind == Collider::Kind::Hull;
}

/// visit(from, way, sharpness, normals of its sides) for every edge of a box or a hull, in the part's own
/// frame.
template <class Visit>
void visitSharpEdges(const Collider& part, Visit&& visit) {
  if (part.kind == Collider::Kind::Box) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 4; ++side) {
        Eigen::Vector3d from = -part.size, way = Eigen::Vector3d::Zero();
        way[axis] = 2 * part.size[axis];
        if (side & 1) from[(axis + 1) % 3] *= -1;
        if (side & 2) from[(axis + 2) % 3] *= -1;
        std::array<Eigen::Vector3d, 2> sides = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
        sides[0][(axis + 1) % 3] = side & 1 ? 1 : -1;
        sides[1][(axis + 2) % 3] = side & 2 ? 1 : -1;
        visit(from, way, 1.0, sides);
      }
    }
  } else if (part.kind == Collider::Kind::Hull) {
    for (const Hull::Edge& edge : part.hull->edges) visit(edge.from, edge.way, edge.sharpness, edge.sides);
  }
}

/// visit(row, range, number from 1, normals of its sides) for those of them that have points between their
/// ends which may be nearer than `reach` to `point`, in the part's own frame.
template <class Visit>
void visitEdgeRows(const Collider& part, double h, const Eigen::Vector3d& point, double reach,
                   Visit&& visit) {
  std::uint32_t number = 0;
  visitSharpEdges(part, [&](const Eigen::Vector3d& from, const Eigen::Vector3d& way, double sharpness,
                            const std::array<Eigen::Vector3d, 2>& sides) {
    ++number;
    // Most edges are far: without a row.
    const double length2 = way.squaredNorm(), along = (point - from).dot(way);
    if (4 * length2 <= h * h ||
        (point - from).squaredNorm() * length2 - along * along >= reach * reach * length2)
      return;
    const EdgeRow row(from, way, sharpness, h);
    const EdgeRow::Range range = row.within(point, reach);
    if (range.count() > 0) visit(row, range, number, sides);
  });
}

/// Sum of the weights that points of edges of the body may have within `reach` of `at` (frame of the rigid
/// body), in a cell of these that reaches as far as `size` [-].
double edgeWeights(const RigidProxy& proxy, const CellFaces& cells, const Eigen::Vector3d& at, double size,
                   double reach);

/// That of all points of a body, times h [m].
double edgeWeight(const RigidProxy& proxy);

}  // namespace rubble::edem
