// Dust grids of the cases: the CPU back end, stage by stage where a case looks at one alone.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "dust/cpu/cpu_dust.h"
#include "dust/lattice.h"

namespace rubble::demo::dust_case {

inline constexpr double kTurn = 6.283185307179586;  // [rad]

/// A cube of that edge about the origin [m], without weight and without what is put in for looks.
inline DustGridDef cube(int resolution, double edge) {
  DustGridDef def;
  def.resolution = resolution;
  def.min.setConstant(float(-edge / 2));
  def.max.setConstant(float(edge / 2));
  def.gravity = def.vorticity = 0;
  return def;
}

/// Calls body(index, centre [m]) for every cell.
template <class Body>
void forCells(const dust::Lattice& lattice, Body&& body) {
  for (int z = 0; z < lattice.n; ++z)
    for (int y = 0; y < lattice.n; ++y)
      for (int x = 0; x < lattice.n; ++x) {
        const Eigen::Vector3d cells = Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5);
        body(
            std::size_t(lattice.index(x, y, z)),
            Eigen::Vector3d(lattice.origin.cast<double>() + cells.cwiseProduct(lattice.cell.cast<double>())));
      }
}

/// Gives the air of every cell flow(centre) [m/s].
template <class Flow>
void setVelocity(dust::CpuDust& grid, const dust::Lattice& lattice, Flow&& flow) {
  std::vector<float> values(grid.valuesOf(dust::Field::Velocity));
  forCells(lattice, [&](std::size_t i, const Eigen::Vector3d& at) {
    const Eigen::Vector3d u = flow(at);
    for (int a = 0; a < 3; ++a) values[4 * i + std::size_t(a)] = float(u[a]);
  });
  grid.write(dust::Field::Velocity, values);
}

/// Root of the sum of squares of what two fields differ by, over that of the second.
inline double relativeError(const std::vector<float>& found, const std::vector<float>& expected) {
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    difference += std::pow(double(found[i]) - double(expected[i]), 2);
    sum += std::pow(double(expected[i]), 2);
  }
  return std::sqrt(difference / sum);
}

}  // namespace rubble::demo::dust_case
