// The pressure solver of cpu/multigrid.h in compute shaders: the same levels, boundaries and order of sweeps.
#pragma once

#include <vector>

#include "dust/gl/gl_kernel.h"
#include "gl/buffer.h"

namespace rubble::dust {

class GlMultigrid {
 public:
  explicit GlMultigrid(const GlKernelSource& source);

  /// Takes over the solids. `air`: DUST_BIND_AIR.
  void setAir(const gl::Buffer& air, bool anySolid);
  /// From zero pressure; `divergence` is the right-hand side.
  void solve(const gl::Buffer& divergence, int cycles);
  const gl::Buffer& pressure() const { return m_levels[0].pressure; }

 private:
  struct Level {
    int n;
    gl::Buffer pressure;  // (n^3) [m^2/s]
    gl::Buffer rhs;       // (n^3) [1/s]; empty on the finest level
    gl::Buffer inverse;   // (n^3) [m^2]
    gl::Buffer weights;   // (6 n^3) [1/m^2]; empty on the finest level
  };

  void bind(std::size_t level, const gl::Buffer& rhs) const;
  void bindCoarse(const Level& coarse) const;
  void cycle(std::size_t level, const gl::Buffer& rhs) const;
  void smooth(std::size_t level, const gl::Buffer& rhs) const;

  const GlKernelSource& m_source;
  GlKernel m_inverse, m_finestWeights, m_weights;
  GlKernel m_finestSmooth, m_smooth, m_finestRestrict, m_restrict, m_prolong, m_coarsest;
  std::vector<Level> m_levels;  // finest first
  bool m_anySolid = true;       // of the last setAir; true so that the first one does its work
};

}  // namespace rubble::dust
