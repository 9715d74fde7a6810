#include "dust/cpu/cpu_dust.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dust/cpu/advection.h"
#include "dust/cpu/forces.h"
#include "dust/cpu/obstacles.h"
#include "dust/cpu/projection.h"
#include "dust/definition.h"

namespace rubble::dust {

CpuDust::CpuDust(const DustGridDef& def)
    : Stages(def),
      m_pool(def.threads),
      m_fields(m_lattice),
      m_pressure(m_lattice),
      m_slabOutflow(std::size_t(def.resolution)),
      m_slabSum(std::size_t(def.resolution)) {
  m_pressure.setAir(m_fields.air, false, m_pool);
}

void CpuDust::addSources(std::span<const shared::DustSourceCell> sources) {
  for (const shared::DustSourceCell& s : sources) {
    m_fields.density[s.cell] += s.velocity.w;
    m_fields.velocity[s.cell] = Float4(s.velocity.x, s.velocity.y, s.velocity.z);
  }
}

void CpuDust::addForces(float dt) {
  assert(dt > 0 && dt <= shared::kDustMaxStep);
  const ForceConstants constants{dt, m_def.gravity / m_def.airDensity, m_def.gravity, m_def.vorticity,
                                 std::exp(-m_def.drag * dt)};
  if (m_def.vorticity > 0) computeCurl(m_lattice, m_fields, m_pool);
  applyForces(m_lattice, constants, m_fields, m_pool);
}

void CpuDust::placeObstacles(std::span<const SolidCells> solids) {
  if (!solids.empty() || m_anySolid) markSolids(m_lattice, solids, m_fields, m_pool);
  m_anySolid = !solids.empty();
  m_pressure.setAir(m_fields.air, m_anySolid, m_pool);
}

void CpuDust::computeDivergence() {
  computeFaces(m_lattice, m_fields, m_pool);
  dust::computeDivergence(m_lattice, m_fields, m_pool);
}

void CpuDust::solvePressure() {
  m_pressure.solve(m_fields.divergence, m_def.pressureCycles, m_pool);
}

void CpuDust::project() {
  subtractGradient(m_lattice, m_pressure.pressure(), m_fields, m_pool);
}

void CpuDust::advectVelocity(float dt) {
  assert(dt > 0 && dt <= shared::kDustMaxStep);
  advect(m_lattice, dt, m_fields, m_pool);
  correctAdvection(m_lattice, dt, m_fields, m_pool);
}

void CpuDust::transportDust(float dt) {
  assert(dt > 0 && dt <= shared::kDustMaxStep);
  const int substeps = toCourantNumbers(m_lattice, dt, settlingSpeed(m_def), m_fields, m_pool);
  const Outflow out = carryDust(m_lattice, substeps, m_fields, m_slabOutflow, m_pool);
  m_settled += out.settled;
  m_left += out.left;
}

void CpuDust::sumTotals() {
  const int n = m_lattice.n;
  m_pool.run(n, n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      double sum = 0;
      const float* d = &m_fields.density[m_lattice.index(0, 0, z)];
      for (int i = 0; i < n * n; ++i) sum += double{d[i]};
      m_slabSum[z] = sum;
    }
  });
  double air = 0;
  for (const double s : m_slabSum) air += s;
  const double volume = m_lattice.volume();
  m_totals = {m_emitted, air * volume, m_settled * volume, m_left * volume + m_outside};
}

void CpuDust::read(Field field, std::vector<float>& values) const {
  values.resize(valuesOf(field));
  const int n = m_lattice.n;
  switch (field) {
    case Field::Velocity:
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = m_fields.velocity[i / 4][int(i % 4)];
      break;
    case Field::Density:
      values = m_fields.density;
      break;
    case Field::Air:
      values = m_fields.air;
      break;
    case Field::Faces:
      values = m_fields.faces;
      break;
    case Field::Divergence:
      values = m_fields.divergence;
      break;
    case Field::Pressure:
      for (int z = 0; z < n; ++z) {
        for (int y = 0; y < n; ++y) {
          std::copy_n(m_pressure.pressure().row(y, z), n, values.begin() + m_lattice.index(0, y, z));
        }
      }
      break;
  }
}

void CpuDust::write(Field field, std::span<const float> values) {
  if (values.size() != valuesOf(field)) throw Error("dust: write: wrong number of values");
  switch (field) {
    case Field::Velocity:
      for (std::size_t i = 0; i < values.size(); ++i) {
        m_fields.velocity[i / 4].set(int(i % 4), values[i]);
      }
      break;
    case Field::Density:
      std::copy(values.begin(), values.end(), m_fields.density.begin());
      break;
    case Field::Air:
      std::copy(values.begin(), values.end(), m_fields.air.begin());
      m_anySolid = true;
      m_pressure.setAir(m_fields.air, true, m_pool);
      break;
    case Field::Faces:
      std::copy(values.begin(), values.end(), m_fields.faces.begin());
      break;
    case Field::Divergence:
      std::copy(values.begin(), values.end(), m_fields.divergence.begin());
      break;
    case Field::Pressure:
      throw Error("dust: write: the pressure is a result");
  }
}

}  // namespace rubble::dust

namespace rubble {

std::unique_ptr<DustGrid> createDustGridCpu(const DustGridDef& def) {
  return std::make_unique<dust::CpuDust>(def);
}

}  // namespace rubble
