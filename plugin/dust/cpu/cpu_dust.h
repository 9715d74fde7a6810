// The CPU back end: the stages on plain arrays. Reference of the GL back end.
#pragma once

#include "base/threads.h"
#include "dust/cpu/fields.h"
#include "dust/cpu/multigrid.h"
#include "dust/cpu/transport.h"
#include "dust/stages.h"

namespace rubble::dust {

class CpuDust final : public Stages {
 public:
  explicit CpuDust(const DustGridDef& def);

  void addSources(std::span<const shared::DustSourceCell> sources) override;
  void addForces(float dt) override;
  void placeObstacles(std::span<const SolidCells> solids) override;
  void computeDivergence() override;
  void solvePressure() override;
  void project() override;
  void advectVelocity(float dt) override;
  void transportDust(float dt) override;
  void sumTotals() override;

  void read(Field field, std::vector<float>& values) const override;
  void write(Field field, std::span<const float> values) override;

  DustTotals totals() const override { return m_totals; }
  const char* backend() const override { return "cpu"; }

  const Multigrid& pressure() const { return m_pressure; }

 private:
  mutable base::ThreadPool m_pool;
  Fields m_fields;
  Multigrid m_pressure;
  bool m_anySolid = false;
  std::vector<Outflow> m_slabOutflow;  // (n)
  std::vector<double> m_slabSum;       // (n)
  double m_settled = 0, m_left = 0;    // density x cells [kg/m^3]
  DustTotals m_totals;
};

}  // namespace rubble::dust
