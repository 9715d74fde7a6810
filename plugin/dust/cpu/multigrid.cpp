#include "dust/cpu/multigrid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/dust.h"

namespace rubble::dust {

namespace {

// A row of the widest grid with a ghost on either side.
using Row = std::array<float, 256 + 2>;

float inverseOf(float diagonal) {
  return diagonal > 0 ? 1 / diagonal : 0;
}

}  // namespace

Multigrid::Multigrid(const Lattice& lattice) {
  Eigen::Vector3f cell = lattice.cell;
  for (int n = lattice.n; n >= shared::kDustCoarsest; n /= 2, cell *= 2) {
    const auto cells = std::size_t(n) * n * n;
    const auto padded = std::size_t(n + 2) * (n + 2) * (n + 2);
    Level level;
    level.n = n;
    for (int a = 0; a < 3; ++a) level.coefficient[a] = 1 / (cell[a] * cell[a]);
    level.pressure.resize(padded);
    level.inverse.resize(cells);
    if (n < lattice.n) {
      level.rhs.resize(cells);
      for (auto& w : level.weights) w.resize(cells);
    }
    m_levels.push_back(std::move(level));
  }
}

void Multigrid::setAir(const std::vector<float>& air, bool anySolid, base::ThreadPool& pool) {
  if (!anySolid && !m_anySolid) return;
  m_anySolid = anySolid;
  setFinest(air, pool);
  // The finest level's weights follow from `air`; those of level 1 are averages of them, and so on.
  const int n = m_levels[1].n;
  pool.run(n, 24 * n * n, [&](int begin, int end) {
    Level& coarse = m_levels[1];
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          float diagonal = 0;
          for (int d = 0; d < 6; ++d) {
            float sum = 0;
            for (int k = 0; k < 4; ++k) {
              int c[3] = {2 * x, 2 * y, 2 * z};
              const int axis = d / 2;
              c[axis] += d % 2;
              c[(axis + 1) % 3] += k % 2;
              c[(axis + 2) % 3] += k / 2;
              sum += finestWeight(air, c[0], c[1], c[2], d);
            }
            // The mean of four faces, and a quarter because cells are twice as large.
            coarse.weights[d][coarse.cell(y, z) + x] = sum / 16;
            diagonal += sum / 16;
          }
          coarse.inverse[coarse.cell(y, z) + x] = inverseOf(diagonal);
        }
      }
    }
  });
  for (std::size_t level = 2; level < m_levels.size(); ++level) coarsenWeights(level, pool);
}

float Multigrid::finestWeight(const std::vector<float>& air, int x, int y, int z, int direction) const {
  const Level& level = m_levels[0];
  int c[3] = {x, y, z};
  const int axis = direction / 2;
  const float own = air[level.cell(y, z) + x] * level.coefficient[axis];
  c[axis] += direction % 2 == 0 ? -1 : 1;
  if (c[axis] >= 0 && c[axis] < level.n) return own * air[level.cell(c[1], c[2]) + c[0]];
  // Outside: the floor is closed; on an open side the pressure is 0 half a cell away.
  return direction == 2 ? 0 : 2 * own;
}

void Multigrid::setFinest(const std::vector<float>& air, base::ThreadPool& pool) {
  const int n = m_levels[0].n;
  pool.run(n, 2 * n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          float diagonal = 0;
          for (int d = 0; d < 6; ++d) diagonal += finestWeight(air, x, y, z, d);
          m_levels[0].inverse[m_levels[0].cell(y, z) + x] = inverseOf(diagonal);
        }
      }
    }
  });
}

void Multigrid::coarsenWeights(std::size_t level, base::ThreadPool& pool) {
  const Level& fine = m_levels[level - 1];
  Level& coarse = m_levels[level];
  pool.run(coarse.n, 24 * coarse.n * coarse.n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < coarse.n; ++y) {
        for (int x = 0; x < coarse.n; ++x) {
          float diagonal = 0;
          for (int d = 0; d < 6; ++d) {
            float sum = 0;
            for (int k = 0; k < 4; ++k) {
              int c[3] = {2 * x, 2 * y, 2 * z};
              const int axis = d / 2;
              c[axis] += d % 2;
              c[(axis + 1) % 3] += k % 2;
              c[(axis + 2) % 3] += k / 2;
              sum += fine.weights[d][fine.cell(c[1], c[2]) + c[0]];
            }
            coarse.weights[d][coarse.cell(y, z) + x] = sum / 16;
            diagonal += sum / 16;
          }
          coarse.inverse[coarse.cell(y, z) + x] = inverseOf(diagonal);
        }
      }
    }
  });
}

// Sum of coefficient times pressure over the six neighbours, for every step-th cell of one row.
template <int step>
void Multigrid::neighbourSum(const Level& level, int first, int y, int z, float* sum) const {
  const float* p = level.row(y, z);
  const float* down = level.row(y - 1, z);
  const float* up = level.row(y + 1, z);
  const float* front = level.row(y, z - 1);
  const float* back = level.row(y, z + 1);
  if (level.rhs.empty()) {
    const float cx = level.coefficient[0], cy = level.coefficient[1], cz = level.coefficient[2];
    for (int x = first; x < level.n; x += step) {
      sum[x] = cx * (p[x - 1] + p[x + 1]) + cy * (down[x] + up[x]) + cz * (front[x] + back[x]);
    }
    return;
  }
  const std::size_t i = level.cell(y, z);
  const float *w0 = &level.weights[0][i], *w1 = &level.weights[1][i], *w2 = &level.weights[2][i],
              *w3 = &level.weights[3][i], *w4 = &level.weights[4][i], *w5 = &level.weights[5][i];
  for (int x = first; x < level.n; x += step) {
    sum[x] = w0[x] * p[x - 1] + w1[x] * p[x + 1] + w2[x] * down[x] + w3[x] * up[x] + w4[x] * front[x] +
             w5[x] * back[x];
  }
}

// Gauss-Seidel on the cells of one colour: their neighbours all have the other one, so order does not matter.
// Whole rows vectorise, half of them for nothing; but where a part of the range ends, the neighbours of the
// other half are just being written by another thread, so there only the cells of the colour are read for.
void Multigrid::smooth(Level& level, const float* rhs, int colour, base::ThreadPool& pool) const {
  const int n = level.n;
  pool.run(n, n * n, [&](int begin, int end) {
    Row next;
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        const int first = (y + z + colour) & 1;
        const bool atEnd = (z == begin && begin > 0) || (z == end - 1 && end < n);
        const float* b = rhs + level.cell(y, z);
        const float* inverse = &level.inverse[level.cell(y, z)];
        float* p = level.row(y, z);
        if (atEnd) {
          neighbourSum<2>(level, first, y, z, next.data());
          for (int x = first; x < n; x += 2) p[x] = (next[x] - b[x]) * inverse[x];
          continue;
        }
        neighbourSum<1>(level, 0, y, z, next.data());
        for (int x = 0; x < n; ++x) next[x] = (next[x] - b[x]) * inverse[x];
        for (int x = first; x < n; x += 2) p[x] = next[x];
      }
    }
  });
}

void Multigrid::residualRow(const Level& level, const float* rhs, int y, int z, float* residual) const {
  neighbourSum<1>(level, 0, y, z, residual);
  const float* b = rhs + level.cell(y, z);
  const float* inverse = &level.inverse[level.cell(y, z)];
  const float* p = level.row(y, z);
  for (int x = 0; x < level.n; ++x) {
    const float diagonal = 1 / std::max(inverse[x], 1e-30f);
    residual[x] = inverse[x] > 0 ? b[x] - residual[x] + diagonal * p[x] : 0;
  }
}

void Multigrid::restrictResidual(const Level& fine, const float* rhs, Level& coarse,
                                 base::ThreadPool& pool) const {
  const int n = coarse.n;
  pool.run(n, 8 * n * n, [&](int begin, int end) {
    Row a, b, c, d;
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        residualRow(fine, rhs, 2 * y, 2 * z, a.data());
        residualRow(fine, rhs, 2 * y + 1, 2 * z, b.data());
        residualRow(fine, rhs, 2 * y, 2 * z + 1, c.data());
        residualRow(fine, rhs, 2 * y + 1, 2 * z + 1, d.data());
        float* out = &coarse.rhs[coarse.cell(y, z)];
        float* p = coarse.row(y, z);
        for (int x = 0; x < 2 * n; ++x) a[x] = (a[x] + b[x]) + (c[x] + d[x]);
        for (int x = 0; x < n; ++x) {
          out[x] = (a[2 * x] + a[2 * x + 1]) / 8;
          p[x] = 0;
        }
      }
    }
  });
}

// The coarse correction on one row of the fine grid: trilinear; mirrored with the other sign at an open side,
// with the same sign at the floor; solids are left out of the mean.
void Multigrid::prolongRow(const Level& coarse, int y, int z, float* correction) const {
  const int n = coarse.n;
  Row sum, share;  // [0] and [n + 1] are ghosts
  std::fill_n(sum.begin(), n + 2, 0.0f);
  std::fill_n(share.begin(), n + 2, 0.0f);
  for (int corner = 0; corner < 4; ++corner) {
    int yy = y / 2, zz = z / 2;
    float weight = (corner % 2 == 0 ? 0.75f : 0.25f) * (corner / 2 == 0 ? 0.75f : 0.25f);
    float sign = 1;
    if (corner % 2 == 1) yy += y % 2 == 0 ? -1 : 1;
    if (corner / 2 == 1) zz += z % 2 == 0 ? -1 : 1;
    if (yy == n || (zz < 0) != (zz == n)) sign = -1;
    if (yy == n && (zz < 0 || zz == n)) sign = 1;
    yy = std::clamp(yy, 0, n - 1);
    zz = std::clamp(zz, 0, n - 1);
    const float* p = coarse.row(yy, zz);
    const float* inverse = &coarse.inverse[coarse.cell(yy, zz)];
    for (int x = 0; x < n; ++x) sum[x + 1] += sign * weight * p[x];
    for (int x = 0; m_anySolid && x < n; ++x) share[x + 1] += inverse[x] > 0 ? weight : 0;
  }
  sum[0] = -sum[1];
  sum[n + 1] = -sum[n];
  for (int x = 0; x < n; ++x) {
    correction[2 * x] = 0.75f * sum[x + 1] + 0.25f * sum[x];
    correction[2 * x + 1] = 0.75f * sum[x + 1] + 0.25f * sum[x + 2];
  }
  if (!m_anySolid) return;
  share[0] = share[1];
  share[n + 1] = share[n];
  for (int x = 0; x < n; ++x) {
    correction[2 * x] /= std::max(0.75f * share[x + 1] + 0.25f * share[x], 1e-6f);
    correction[2 * x + 1] /= std::max(0.75f * share[x + 1] + 0.25f * share[x + 2], 1e-6f);
  }
}

void Multigrid::prolong(const Level& coarse, Level& fine, base::ThreadPool& pool) const {
  const int n = fine.n;
  pool.run(n, n * n, [&](int begin, int end) {
    Row correction;
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        prolongRow(coarse, y, z, correction.data());
        const float* inverse = &fine.inverse[fine.cell(y, z)];
        float* p = fine.row(y, z);
        for (int x = 0; x < n; ++x) p[x] += inverse[x] > 0 ? correction[x] : 0;
      }
    }
  });
}

void Multigrid::cycle(std::size_t index, const float* rhs, base::ThreadPool& pool) {
  Level& level = m_levels[index];
  if (level.n == shared::kDustCoarsest) {
    for (int sweep = 0; sweep < 2 * shared::kDustCoarsestSweeps; ++sweep) smooth(level, rhs, sweep & 1, pool);
    return;
  }
  Level& coarse = m_levels[index + 1];
  smooth(level, rhs, 0, pool);
  smooth(level, rhs, 1, pool);
  restrictResidual(level, rhs, coarse, pool);
  cycle(index + 1, coarse.rhs.data(), pool);
  prolong(coarse, level, pool);
  smooth(level, rhs, 0, pool);
  smooth(level, rhs, 1, pool);
}

void Multigrid::solve(const std::vector<float>& divergence, int cycles, base::ThreadPool& pool) {
  std::fill(m_levels[0].pressure.begin(), m_levels[0].pressure.end(), 0.0f);
  for (int i = 0; i < cycles; ++i) cycle(0, divergence.data(), pool);
}

double Multigrid::relativeResidual(const std::vector<float>& divergence) const {
  const Level& level = m_levels[0];
  Row row;
  double residual = 0, scale = 0;
  for (int z = 0; z < level.n; ++z) {
    for (int y = 0; y < level.n; ++y) {
      residualRow(level, divergence.data(), y, z, row.data());
      for (int x = 0; x < level.n; ++x) {
        const double b = double{divergence[level.cell(y, z) + x]};
        residual += double{row[x]} * double{row[x]};
        scale += b * b;
      }
    }
  }
  return scale > 0 ? std::sqrt(residual / scale) : 0;
}

}  // namespace rubble::dust
