#include "dust/sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubble::dust {

namespace {

bool usable(const DustSource& s) {
  return s.position.allFinite() && s.velocity.allFinite() && s.mass > 0 &&
         s.mass <= shared::kDustMaxSourceMass;
}

}  // namespace

void SourceCells::gather(const Lattice& lattice, std::span<const DustSource> sources) {
  m_order.clear();
  m_cells.clear();
  m_emitted = m_outside = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!usable(sources[i])) continue;
    const double mass = double{sources[i].mass};
    m_emitted += mass;
    const int cell = lattice.cellAt(sources[i].position);
    if (cell < 0) {
      m_outside += mass;
    } else {
      m_order.emplace_back(cell, int(i));
    }
  }
  std::sort(m_order.begin(), m_order.end());
  for (std::size_t first = 0; first < m_order.size();) {
    double mass = 0;
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    std::size_t i = first;
    for (; i < m_order.size() && m_order[i].first == m_order[first].first; ++i) {
      const DustSource& s = sources[m_order[i].second];
      mass += double{s.mass};
      momentum += double{s.mass} * s.velocity.cast<double>();
    }
    Eigen::Vector3d v = momentum / mass;
    const double speed = v.norm();
    if (speed > double{shared::kDustMaxSpeed}) v *= double{shared::kDustMaxSpeed} / speed;
    const Eigen::Vector3f u = v.cast<float>();
    m_cells.push_back(
        {{u.x(), u.y(), u.z(), float(mass / lattice.volume())}, shared::uint(m_order[first].first), 0, 0, 0});
    first = i;
  }
}

}  // namespace rubble::dust
