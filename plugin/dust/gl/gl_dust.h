// The compute back end: the stages as shaders on storage buffers of floats. Kernel for kernel it follows the
// CPU back end, against which it is tested.
#pragma once

#include <string>
#include <vector>

#include "dust/gl/gl_kernel.h"
#include "dust/gl/gl_multigrid.h"
#include "dust/gl/gl_totals.h"
#include "dust/stages.h"
#include "gl/buffer.h"
#include "gl/capabilities.h"
#include "gl/guest.h"

namespace rubble::dust {

class GlDust final : public Stages {
 public:
  GlDust(const DustGridDef& def, const std::string& shaderDirectory);

  void step(float dt, std::span<const DustSource> sources, std::span<const DustObstacle> obstacles) override;

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

  DustTotals totals() const override { return m_totals.arrived(); }
  const char* backend() const override { return "gl"; }
  std::uint32_t densityBuffer() const override { return m_density.id(); }

 private:
  GlDust(const DustGridDef& def, const std::string& shaderDirectory, const gl::Capabilities& capabilities);
  // The guest lives until everything is made.
  GlDust(const DustGridDef& def, const std::string& shaderDirectory, const gl::Capabilities& capabilities,
         const gl::Guest&);
  void setStep(float dt);
  template <class T>
  void sendList(std::span<const T> items);
  const gl::Buffer& bufferOf(Field field) const;

  gl::Capabilities m_capabilities;
  GlKernelSource m_source;
  GlKernel m_addSources, m_curl, m_forces, m_obstacles, m_faceVelocities, m_divergenceOf;
  GlKernel m_projectFaces, m_projectCells, m_advect, m_correct, m_courant, m_schedule, m_sweep;
  gl::Buffer m_velocity;    // vec4 (n^3) [m/s]
  gl::Buffer m_work;        // vec4 (n^3) curl, then the advected velocity
  gl::Buffer m_corrected;   // vec4 (n^3) exchanged with m_velocity
  gl::Buffer m_density;     // (n^3) [kg/m^3]
  gl::Buffer m_air;         // (n^3) 1 air, 0 solid
  gl::Buffer m_faces;       // (3 n^2 (n+1)) [m/s], then Courant numbers
  gl::Buffer m_divergence;  // (n^3) [1/s]
  gl::Buffer m_outflow;     // vec2 (6 n^2) dust through the sides since the start
  gl::Buffer m_substeps;    // layout in shaders/dust/schedule.glsl
  gl::Buffer m_params;      // DustParams
  gl::Buffer m_list;        // sources, then obstacles; grows
  GlMultigrid m_pressure;
  GlTotals m_totals;
  std::vector<shared::DustSolid> m_solidList;
  bool m_anySolid = false;
};

}  // namespace rubble::dust
