#include "dust/gl/gl_multigrid.h"

#include "shared/dust.h"

namespace rubble::dust {

namespace {

constexpr const char* kFinest = "#define DUST_FINEST\n";

}  // namespace

GlMultigrid::GlMultigrid(const GlKernelSource& source)
    : m_source(source),
      m_inverse(source.build("inverse.comp")),
      m_finestWeights(source.build("weights.comp", kFinest)),
      m_weights(source.build("weights.comp")),
      m_finestSmooth(source.build("smooth.comp", kFinest)),
      m_smooth(source.build("smooth.comp")),
      m_finestRestrict(source.build("restrict.comp", kFinest)),
      m_restrict(source.build("restrict.comp")),
      m_prolong(source.build("prolong.comp")),
      m_coarsest(source.build("coarsest.comp")) {
  for (int n = source.n(); n >= shared::kDustCoarsest; n /= 2) {
    const auto cells = std::size_t(n) * n * n;
    Level level{n, gl::bufferOf<float>(cells), {}, gl::bufferOf<float>(cells), {}};
    if (n < source.n()) {
      level.rhs = gl::bufferOf<float>(cells);
      level.weights = gl::bufferOf<float>(6 * cells);
    }
    m_levels.push_back(std::move(level));
  }
}

void GlMultigrid::setAir(const gl::Buffer& air, bool anySolid) {
  if (!anySolid && !m_anySolid) return;
  m_anySolid = anySolid;
  air.bindStorage(DUST_BIND_AIR);
  m_levels[0].inverse.bindStorage(DUST_BIND_INVERSE);
  m_source.runOnCells(m_inverse);
  for (std::size_t i = 1; i < m_levels.size(); ++i) {
    const Level& coarse = m_levels[i];
    const GlKernel& kernel = i == 1 ? m_finestWeights : m_weights;
    if (i > 1) m_levels[i - 1].weights.bindStorage(DUST_BIND_WEIGHTS);
    coarse.weights.bindStorage(DUST_BIND_COARSE_WEIGHTS);
    coarse.inverse.bindStorage(DUST_BIND_COARSE_INVERSE);
    kernel.set(DUST_UNIFORM_A, coarse.n);
    const int groups = coarse.n / kLevelGroup;
    kernel.run(groups, groups, groups);
  }
}

void GlMultigrid::bind(std::size_t index, const gl::Buffer& rhs) const {
  const Level& level = m_levels[index];
  level.pressure.bindStorage(DUST_BIND_PRESSURE);
  rhs.bindStorage(DUST_BIND_RHS);
  level.inverse.bindStorage(DUST_BIND_INVERSE);
  if (index > 0) level.weights.bindStorage(DUST_BIND_WEIGHTS);
}

void GlMultigrid::bindCoarse(const Level& coarse) const {
  coarse.pressure.bindStorage(DUST_BIND_COARSE_PRESSURE);
  coarse.rhs.bindStorage(DUST_BIND_COARSE_RHS);
  coarse.inverse.bindStorage(DUST_BIND_COARSE_INVERSE);
}

// Both colours, a thread a cell of the colour: half as many along x.
void GlMultigrid::smooth(std::size_t index, const gl::Buffer& rhs) const {
  const GlKernel& kernel = index == 0 ? m_finestSmooth : m_smooth;
  bind(index, rhs);
  kernel.set(DUST_UNIFORM_A, m_levels[index].n);
  const int groups = m_levels[index].n / kLevelGroup;
  for (int colour = 0; colour < 2; ++colour) {
    kernel.set(DUST_UNIFORM_B, colour);
    kernel.run(groups / 2, groups, groups);
  }
}

void GlMultigrid::cycle(std::size_t index, const gl::Buffer& rhs) const {
  const Level& level = m_levels[index];
  if (level.n == shared::kDustCoarsest) {
    bind(index, rhs);
    m_coarsest.set(DUST_UNIFORM_A, level.n);
    m_coarsest.run(1);
    return;
  }
  const Level& coarse = m_levels[index + 1];
  const int fineGroups = level.n / kLevelGroup, coarseGroups = coarse.n / kLevelGroup;
  smooth(index, rhs);

  const GlKernel& restriction = index == 0 ? m_finestRestrict : m_restrict;
  bindCoarse(coarse);
  restriction.set(DUST_UNIFORM_A, level.n);
  restriction.run(coarseGroups, coarseGroups, coarseGroups);

  cycle(index + 1, coarse.rhs);

  bind(index, rhs);
  bindCoarse(coarse);
  m_prolong.set(DUST_UNIFORM_A, level.n);
  m_prolong.run(fineGroups, fineGroups, fineGroups);
  smooth(index, rhs);
}

void GlMultigrid::solve(const gl::Buffer& divergence, int cycles) {
  m_levels[0].pressure.clear();
  for (int i = 0; i < cycles; ++i) cycle(0, divergence);
}

}  // namespace rubble::dust
