// Grids, flows and sums that several tests of the dust grid need.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "dust/cpu/cpu_dust.h"
#include "dust/lattice.h"
#include "rubble/dust.h"

namespace rubble::test {

using dust::CpuDust;
using dust::Field;
using dust::Lattice;

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A cube of `side` metres on the ground, in the middle of x and z.
inline DustGridDef cube(int resolution, float side) {
  DustGridDef def;
  def.resolution = resolution;
  def.min = Eigen::Vector3f(-side / 2, 0, -side / 2);
  def.max = Eigen::Vector3f(side / 2, side, side / 2);
  return def;
}

/// Centre of cell (x, y, z) [m].
inline Eigen::Vector3d centre(const dust::Lattice& lattice, int x, int y, int z) {
  return lattice.origin.cast<double>() + (Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5))
                                             .cwiseProduct(lattice.cell.cast<double>());
}

/// Calls body(index, centre) for every cell.
template <class Body>
void forCells(const dust::Lattice& lattice, Body&& body) {
  for (int z = 0; z < lattice.n; ++z) {
    for (int y = 0; y < lattice.n; ++y) {
      for (int x = 0; x < lattice.n; ++x) body(lattice.index(x, y, z), centre(lattice, x, y, z));
    }
  }
}

/// Numbers in [-1, 1) that are the same everywhere: Numerical Recipes' linear congruence.
class Sequence {
 public:
  float next() {
    m_state = m_state * 1664525u + 1013904223u;
    return float(m_state >> 8) / 8388608.0f - 1;
  }

 private:
  std::uint32_t m_state = 12345;
};

/// A wall of 32 elements broken each frame: 0.32 kg a frame, thrown at up to 20 m/s in every direction.
inline std::vector<DustSource> burst(Sequence& random) {
  std::vector<DustSource> sources;
  for (int i = 0; i < 32; ++i) {
    const Eigen::Vector3f at(random.next(), 1 + 0.9f * random.next(), random.next());
    const Eigen::Vector3f v(random.next(), random.next(), random.next());
    sources.push_back({at, 20 * v, 0.01f, 1e-6f});
  }
  return sources;
}

/// Root of the mean square.
inline double rms(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double{v} * double{v};
  return std::sqrt(sum / double(values.size()));
}

/// Centre of mass of a field of one float a cell [m].
inline Eigen::Vector3d centroid(const dust::Lattice& lattice, const std::vector<float>& field) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double sum = 0;
  forCells(lattice, [&](int i, const Eigen::Vector3d& at) {
    moment += double{field[i]} * at;
    sum += double{field[i]};
  });
  return moment / sum;
}

inline void setVelocity(dust::CpuDust& grid, const dust::Lattice& lattice, auto&& flow) {
  std::vector<float> values(grid.valuesOf(dust::Field::Velocity));
  forCells(lattice, [&](int i, const Eigen::Vector3d& at) {
    const Eigen::Vector3f u = flow(at);
    for (int a = 0; a < 3; ++a) values[4 * i + a] = u[a];
  });
  grid.write(dust::Field::Velocity, values);
}

}  // namespace rubble::test
