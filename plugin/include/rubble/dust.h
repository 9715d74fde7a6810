// The dust grid: stable fluids carrying dust, on the CPU or in GL compute shaders. One interface; the CPU
// back end is the reference of the other. Called by the application once a frame, after stepSimulation
// (DustGrid::step).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rubble/dust_source.h"
#include "rubble/error.h"

namespace rubble {

/// A solid in the air. Cells whose centre lies inside take its velocity and hold no dust flow through them.
struct DustObstacle {
  enum class Kind : std::uint32_t { Sphere, Box };
  Kind kind = Kind::Sphere;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< of its centre [m]
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  /// Of a box [m]; x of a sphere is its radius.
  Eigen::Vector3f halfExtents = Eigen::Vector3f::Constant(0.5f);
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();  ///< linear [m/s]
  Eigen::Vector3f spin = Eigen::Vector3f::Zero();      ///< angular [rad/s]
};

struct DustGridDef {
  /// Cells along each axis: a power of two, 8 to 256.
  int resolution = 64;
  /// The box of the grid in the world [m]. Its floor (min y) is ground: dust settles there. The other five
  /// sides are open to dust: what drifts out has left.
  Eigen::Vector3f min = Eigen::Vector3f(-2, 0, -2);
  Eigen::Vector3f max = Eigen::Vector3f(2, 3, 2);
  float grainRadius = 1e-6f;     ///< R_dust [m]; sets the settling speed (Stokes) and the extinction
  float grainDensity = 2400;     ///< [kg/m^3]
  float airDensity = 1.2f;       ///< [kg/m^3]; dust-laden air is heavier and sinks (Boussinesq, clamped)
  float airViscosity = 1.8e-5f;  ///< dynamic [Pa s]; for the Stokes settling speed
  float gravity = 9.81f;         ///< [m/s^2], along -y
  float vorticity = 0.3f;  ///< strength of vorticity confinement, dimensionless (0 off, usual 0.1 to 0.5)
  float drag = 0.0f;       ///< decay rate of the air's velocity [1/s]
  int pressureCycles = 3;  ///< multigrid V(1,1) cycles a step
  int threads = 1;         ///< of the CPU back end; results do not depend on it
};

/// Where the emitted dust is now [kg]. emitted = air + settled + left + error.
struct DustTotals {
  double emitted = 0;
  double air = 0;
  double settled = 0;
  double left = 0;
  /// |emitted - air - settled - left| / emitted, dimensionless; 0 when nothing was emitted.
  double error() const;
};

class DustGrid {
 public:
  virtual ~DustGrid() = default;

  /// Advances the air and its dust by `dt` seconds. The GL back end needs its context current.
  virtual void step(float dt, std::span<const DustSource> sources,
                    std::span<const DustObstacle> obstacles) = 0;

  /// Sums of the last step whose results have arrived: exact on the CPU, a step late on GL (never waited
  /// for).
  virtual DustTotals totals() const = 0;

  /// Dust density of every cell [kg/m^3], x fastest, then y, then z (n^3). Waits for the GL back end: tests
  /// and exports.
  virtual void readDensity(std::vector<float>& density) const = 0;
  /// Air velocity of every cell [m/s], same order.
  virtual void readVelocity(std::vector<Eigen::Vector3f>& velocity) const = 0;

  /// "cpu" or "gl".
  virtual const char* backend() const = 0;
  const DustGridDef& def() const { return m_def; }
  std::size_t cellCount() const;
  Eigen::Vector3f cellSize() const;  ///< [m]

  /// GL buffer (SSBO, n^3 floats, kg/m^3) that the renderer may read directly, or 0 on the CPU back end.
  virtual std::uint32_t densityBuffer() const { return 0; }

 protected:
  explicit DustGrid(const DustGridDef& def) : m_def(def) {}
  DustGridDef m_def;
};

/// Plain C++ on `def.threads` threads. Throws rubble::Error for a bad definition.
std::unique_ptr<DustGrid> createDustGridCpu(const DustGridDef& def);
/// Compute shaders in the current GL 4.3+ context. Throws rubble::Error without one. `shaderDirectory` holds
/// dust/*.comp.
///
/// This call, step() and the reading of fields depend on none of the caller's GL state and leave it as it
/// was, with these exceptions: errors that the caller has not fetched by glGetError are discarded, a
/// conditional render in progress is ended (not by reading), a program that was deleted while it is in use is
/// gone.
std::unique_ptr<DustGrid> createDustGridGl(const DustGridDef& def, const std::string& shaderDirectory);

/// Mass extinction of a cloud of grains of radius R [m] and density rho [kg/m^3]: 3 / (2 rho R_dust)
/// [m^2/kg], the geometric limit (extinction efficiency 2) for spheres. About 625 for concrete at 1
/// micrometre.
float massExtinction(float grainDensity, float grainRadius);

}  // namespace rubble
