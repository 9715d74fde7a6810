#include "edem/edge_points.h"

#include <algorithm>
#include <cmath>

namespace rubble::edem {

EdgeRow::EdgeRow(const Eigen::Vector3d& from, const Eigen::Vector3d& way, double sharpness, double h)
    : m_from(from), m_way(way) {
  const double length = way.norm();
  while (m_level < kLevels && 2 * length > h * m_count) {
    ++m_level;
    m_count *= 2;
  }
  m_weight = 0.5 * sharpness * std::min(length / m_count / h, 0.5);
}

EdgeRow::Range EdgeRow::within(const Eigen::Vector3d& point, double reach) const {
  const double length2 = m_way.squaredNorm();
  if (!(length2 > 0)) return {};
  const Eigen::Vector3d from = point - m_from;
  const double foot = from.dot(m_way) / length2;
  const double left2 = reach * reach - (from - foot * m_way).squaredNorm();
  if (!(left2 > 0)) return {};
  const double half = std::sqrt(left2 / length2), first = std::ceil((foot - half) * m_count),
               last = std::floor((foot + half) * m_count);
  Range range;
  range.first = std::uint32_t(std::clamp(first, 1.0, double(m_count)));
  range.last = std::uint32_t(std::clamp(last + 1, double(range.first), double(m_count)));
  return range;
}

std::uint32_t EdgeRow::most(double size) const {
  const double count = std::floor(size / m_way.norm() * m_count) + 1;
  return std::uint32_t(std::min(count, double(m_count - 1)));
}

double edgeWeights(const RigidProxy& proxy, const CellFaces& cells, const Eigen::Vector3d& at, double size,
                   double reach) {
  const double h = std::sqrt(cells.unit);
  double sum = 0;
  for (const Collider& part : proxy.parts) {
    if (!hasEdges(part)) continue;
    const Eigen::Vector3d centre = part.place.inverse(Eigen::Isometry) * at;
    visitEdgeRows(part, h, centre, reach + part.rounding,
                  [&](const EdgeRow& row, const EdgeRow::Range& near, std::uint32_t,
                      const std::array<Eigen::Vector3d, 2>&) {
                    sum += row.weight() * std::min(near.count(), row.most(2 * (size + part.rounding)));
                  });
  }
  return sum;
}

double edgeWeight(const RigidProxy& proxy) {
  double sum = 0;
  for (const Collider& part : proxy.parts)
    visitSharpEdges(part,
                    [&](const Eigen::Vector3d&, const Eigen::Vector3d& way, double sharpness,
                        const std::array<Eigen::Vector3d, 2>&) { sum += 0.5 * sharpness * way.norm(); });
  return sum;
}

}  // namespace rubble::edem
