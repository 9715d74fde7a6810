#include "dust/stages.h"

#include <algorithm>

#include "dust/definition.h"

namespace rubble::dust {

namespace {

const DustGridDef& checked(const DustGridDef& def) {
  checkDefinition(def);
  return def;
}

}  // namespace

Stages::Stages(const DustGridDef& def) : DustGrid(checked(def)), m_lattice(def) {}

void Stages::step(float dt, std::span<const DustSource> sources, std::span<const DustObstacle> obstacles) {
  const float h = dt > 0 ? std::min(dt, shared::kDustMaxStep) : 0;
  m_sources.gather(m_lattice, sources);
  m_emitted += m_sources.emitted();
  m_outside += m_sources.outside();
  gatherSolids(m_lattice, obstacles, m_solids);

  addSources(m_sources.cells());
  if (h > 0) {
    addForces(h);
    placeObstacles(m_solids);
    computeDivergence();
    solvePressure();
    project();
    advectVelocity(h);
    transportDust(h);
  }
  sumTotals();
}

std::size_t Stages::valuesOf(Field field) const {
  switch (field) {
    case Field::Velocity:
      return 4 * m_lattice.cells();
    case Field::Faces:
      return 3 * m_lattice.facesOfAxis();
    default:
      return m_lattice.cells();
  }
}

void Stages::readVelocity(std::vector<Eigen::Vector3f>& velocity) const {
  std::vector<float> values;
  read(Field::Velocity, values);
  velocity.resize(m_lattice.cells());
  for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = Eigen::Map<Eigen::Vector3f>(&values[4 * i]);
}

}  // namespace rubble::dust
