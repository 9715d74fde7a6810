#include "dust/cpu/obstacles.h"

#include <algorithm>
#include <cmath>

namespace rubble::dust {

namespace {

using shared::vec4;

Eigen::Vector3f xyz(const vec4& v) {
  return {v.x, v.y, v.z};
}

bool holds(const shared::DustSolid& s, const Eigen::Vector3f& offset) {
  if (s.position.w == 0) return offset.squaredNorm() <= s.axisX.w * s.axisX.w;
  return std::abs(offset.dot(xyz(s.axisX))) <= s.axisX.w && std::abs(offset.dot(xyz(s.axisY))) <= s.axisY.w &&
         std::abs(offset.dot(xyz(s.axisZ))) <= s.axisZ.w;
}

void markSlab(const Lattice& lattice, const SolidCells& cells, int z, Fields& fields) {
  const shared::DustSolid& s = cells.solid;
  const Float4 most = Float4::all(shared::kDustMaxSpeed), least = Float4::all(-shared::kDustMaxSpeed);
  for (int y = cells.first.y(); y <= cells.last.y(); ++y) {
    for (int x = cells.first.x(); x <= cells.last.x(); ++x) {
      const Eigen::Vector3f steps(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f);
      const Eigen::Vector3f offset = lattice.origin + steps.cwiseProduct(lattice.cell) - xyz(s.position);
      if (!holds(s, offset)) continue;
      const Eigen::Vector3f v = xyz(s.velocity) + xyz(s.spin).cross(offset);
      const int i = lattice.index(x, y, z);
      fields.air[i] = 0;
      fields.velocity[i] = clamp(Float4(v.x(), v.y(), v.z()), least, most);
    }
  }
}

}  // namespace

void markSolids(const Lattice& lattice, std::span<const SolidCells> solids, Fields& fields,
                base::ThreadPool& pool) {
  std::fill(fields.air.begin(), fields.air.end(), 1.0f);
  for (const SolidCells& cells : solids) {
    const Eigen::Vector3i size = cells.last - cells.first + Eigen::Vector3i::Ones();
    pool.run(size.z(), size.x() * size.y(), [&](int begin, int end) {
      for (int z = begin; z < end; ++z) markSlab(lattice, cells, cells.first.z() + z, fields);
    });
  }
}

}  // namespace rubble::dust
