// Pressure by geometric multigrid: laplace(p) = divergence, V(1,1) cycles of red-black Gauss-Seidel.
//
// Boundary: p = 0 on the five open sides (a box in open air), no flow through the floor and through solids.
// All of it is in the inverse diagonal: cells of a solid and ghosts outside hold p = 0 and are left out of
// the diagonal, so the smoother of the finest level has neither branches nor coefficients to load. Coarse
// levels average the coefficients of the faces they merge, so thin solids keep their share.
#pragma once

#include <vector>

#include "base/threads.h"
#include "dust/cpu/projection.h"
#include "dust/lattice.h"

namespace rubble::dust {

class Multigrid {
 public:
  explicit Multigrid(const Lattice& lattice);

  /// Takes over the solids. `air` (n^3): 1 air, 0 solid.
  void setAir(const std::vector<float>& air, bool anySolid, base::ThreadPool& pool);
  /// Starts from zero pressure: a closed pocket of air has no unique pressure and would drift with a warm
  /// start.
  void solve(const std::vector<float>& divergence, int cycles, base::ThreadPool& pool);

  PaddedPressure pressure() const { return {m_levels[0].pressure.data(), m_levels[0].n + 2}; }
  /// Root of the sum of squares of divergence - laplace(p) over that of the divergence.
  double relativeResidual(const std::vector<float>& divergence) const;

 private:
  struct Level {
    int n;
    float coefficient[3];         // 1 / cell size^2 along x, y, z [1/m^2]
    std::vector<float> pressure;  // ((n+2)^3) with zero ghosts [m^2/s]
    std::vector<float> rhs;       // (n^3) [1/s]; empty on the finest level
    std::vector<float> inverse;   // (n^3) 1 / diagonal [m^2]; 0 in a solid
    /// (n^3) coefficient of low x, high x, low y, ... [1/m^2]; empty on the finest level.
    std::vector<float> weights[6];
    float* row(int y, int z) { return pressure.data() + offset(y, z); }
    const float* row(int y, int z) const { return pressure.data() + offset(y, z); }
    std::size_t cell(int y, int z) const { return (std::size_t(z) * n + y) * n; }

   private:
    std::size_t offset(int y, int z) const {
      const auto s = std::size_t(n) + 2;
      return (std::size_t(z + 1) * s + std::size_t(y + 1)) * s + 1;
    }
  };

  void setFinest(const std::vector<float>& air, base::ThreadPool& pool);
  void coarsenWeights(std::size_t level, base::ThreadPool& pool);
  float finestWeight(const std::vector<float>& air, int x, int y, int z, int direction) const;
  template <int step>
  void neighbourSum(const Level& level, int first, int y, int z, float* sum) const;
  void cycle(std::size_t level, const float* rhs, base::ThreadPool& pool);
  void smooth(Level& level, const float* rhs, int colour, base::ThreadPool& pool) const;
  void restrictResidual(const Level& fine, const float* rhs, Level& coarse, base::ThreadPool& pool) const;
  void residualRow(const Level& level, const float* rhs, int y, int z, float* residual) const;
  void prolong(const Level& coarse, Level& fine, base::ThreadPool& pool) const;
  void prolongRow(const Level& coarse, int y, int z, float* correction) const;

  std::vector<Level> m_levels;  // finest first
  bool m_anySolid = true;       // of the last setAir; true so that the first one does its work
};

}  // namespace rubble::dust
