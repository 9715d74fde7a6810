// The step of the dust grid, written once: both back ends fill in the stages. Tests call the stages one by
// one and compare the back ends field by field.
#pragma once

#include <span>
#include <vector>

#include "dust/lattice.h"
#include "dust/solids.h"
#include "dust/sources.h"
#include "rubble/dust.h"

namespace rubble::dust {

/// What can be read from and written to a back end, in the order of Lattice::index and Lattice::face.
enum class Field {
  Velocity,    ///< 4 floats a cell [m/s], the fourth unused
  Density,     ///< 1 float a cell [kg/m^3]
  Air,         ///< 1 float a cell: 1 air, 0 solid
  Faces,       ///< normal velocity of all x, then y, then z faces [m/s]; Courant numbers after transportDust
  Divergence,  ///< 1 float a cell [1/s]
  Pressure,    ///< 1 float a cell, times dt / density of air [m^2/s]
};

class Stages : public DustGrid {
 public:
  explicit Stages(const DustGridDef& def);

  /// dt is cut to [0, kDustMaxStep] (not a number counts as 0); with 0 the sources are added and nothing
  /// moves.
  void step(float dt, std::span<const DustSource> sources, std::span<const DustObstacle> obstacles) override;

  virtual void addSources(std::span<const shared::DustSourceCell> sources) = 0;
  virtual void addForces(float dt) = 0;
  virtual void placeObstacles(std::span<const SolidCells> solids) = 0;
  virtual void computeDivergence() = 0;
  virtual void solvePressure() = 0;
  virtual void project() = 0;
  virtual void advectVelocity(float dt) = 0;
  virtual void transportDust(float dt) = 0;
  virtual void sumTotals() = 0;

  virtual void read(Field field, std::vector<float>& values) const = 0;
  virtual void write(Field field, std::span<const float> values) = 0;
  std::size_t valuesOf(Field field) const;

  void readDensity(std::vector<float>& density) const final { read(Field::Density, density); }
  void readVelocity(std::vector<Eigen::Vector3f>& velocity) const final;

 protected:
  Lattice m_lattice;
  double m_emitted = 0;  ///< [kg] since the start
  double m_outside = 0;  ///< [kg] emitted outside the grid: it has left at once

 private:
  SourceCells m_sources;
  std::vector<SolidCells> m_solids;
};

}  // namespace rubble::dust
