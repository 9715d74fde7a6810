#include "dust/gl/gl_dust.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dust/definition.h"
#include "gl/bindings.h"
#include "gl/error.h"
#include "rubble/machine_error.h"
#include "shared/dust.h"

namespace rubble::dust {

namespace {

using shared::vec4;

static_assert(DUST_BIND_LIST < gl::kGuestStorageBuffers && DUST_BIND_PARAMS < gl::kGuestUniformBuffers,
              "what the kernels bind is given back to the caller");

// Before the first GL object. Returns the directory, so that it stands in front of the other members.
const std::string& checkedDriver(const Lattice& lattice, const std::string& shaderDirectory) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  const auto largest = GLint64(lattice.cells() * sizeof(vec4));
  if (largest > most) {
    throw MachineError("dust: resolution: a storage buffer of " + std::to_string(largest) +
                       " bytes is needed, the driver has at most " + std::to_string(most));
  }
  return shaderDirectory;
}

gl::Capabilities checkedCapabilities(const DustGridDef& def) {
  checkDefinition(def);
  return gl::capabilitiesNow("dust: the GL back end");
}

}  // namespace

GlDust::GlDust(const DustGridDef& def, const std::string& shaderDirectory)
    : GlDust(def, shaderDirectory, checkedCapabilities(def)) {}

GlDust::GlDust(const DustGridDef& def, const std::string& shaderDirectory,
               const gl::Capabilities& capabilities)
    : GlDust(def, shaderDirectory, capabilities, gl::Guest(capabilities)) {}

GlDust::GlDust(const DustGridDef& def, const std::string& shaderDirectory,
               const gl::Capabilities& capabilities, const gl::Guest&)
    : Stages(def),
      m_capabilities(capabilities),
      m_source(checkedDriver(m_lattice, shaderDirectory), def.resolution),
      m_addSources(m_source.build("add_sources.comp")),
      m_curl(m_source.build("curl.comp")),
      m_forces(m_source.build("forces.comp")),
      m_obstacles(m_source.build("obstacles.comp")),
      m_faceVelocities(m_source.build("faces.comp")),
      m_divergenceOf(m_source.build("divergence.comp")),
      m_projectFaces(m_source.build("project_faces.comp")),
      m_projectCells(m_source.build("project_cells.comp")),
      m_advect(m_source.build("advect.comp")),
      m_correct(m_source.build("advect_correct.comp")),
      m_courant(m_source.build("courant.comp")),
      m_schedule(m_source.build("schedule.comp")),
      m_sweep(m_source.build("sweep.comp")),
      m_velocity(m_lattice.cells() * sizeof(vec4)),
      m_work(m_lattice.cells() * sizeof(vec4)),
      m_corrected(m_lattice.cells() * sizeof(vec4)),
      m_density(m_lattice.cells() * sizeof(float)),
      m_air(m_lattice.cells() * sizeof(float)),
      m_faces(3 * m_lattice.facesOfAxis() * sizeof(float)),
      m_divergence(m_lattice.cells() * sizeof(float)),
      m_outflow(std::size_t(def.resolution * def.resolution) * 12 * sizeof(float)),
      m_substeps(shared::kDustMaxSubsteps * sizeof(shared::DustDispatch) + 2 * sizeof(shared::uint)),
      m_params(sizeof(shared::DustParams)),
      m_pressure(m_source),
      m_totals(m_source, m_lattice.volume()) {
  const std::vector<float> air(m_lattice.cells(), 1.0f);
  m_air.write(std::as_bytes(std::span(air)));
  setStep(0);
  m_pressure.setAir(m_air, false);
  gl::checkGl("creation of a dust grid");
}

void GlDust::step(float dt, std::span<const DustSource> sources, std::span<const DustObstacle> obstacles) {
  const gl::Guest guest(m_capabilities);
  Stages::step(dt, sources, obstacles);
  gl::checkGl("a step of the dust grid");
}

// The constants of a stage. Bound each time: another part of the program may use the binding point.
void GlDust::setStep(float dt) {
  const Eigen::Vector3f &cell = m_lattice.cell, &origin = m_lattice.origin;
  const Eigen::Vector3f inverse = cell.cwiseInverse();
  const shared::DustParams params = {{cell.x(), cell.y(), cell.z(), cell.minCoeff()},
                                     {origin.x(), origin.y(), origin.z(), dt},
                                     {inverse.x(), inverse.y(), inverse.z(), std::exp(-m_def.drag * dt)},
                                     {m_def.gravity / m_def.airDensity, shared::kDustMaxLoad * m_def.gravity,
                                      m_def.vorticity, settlingSpeed(m_def)}};
  m_params.write(std::as_bytes(std::span(&params, 1)));
  m_params.bindBase(GL_UNIFORM_BUFFER, DUST_BIND_PARAMS);
}

template <class T>
void GlDust::sendList(std::span<const T> items) {
  m_list.upload(items, GL_DYNAMIC_COPY);
  m_list.bindStorage(DUST_BIND_LIST);
}

void GlDust::addSources(std::span<const shared::DustSourceCell> sources) {
  if (sources.empty()) return;
  sendList(sources);
  m_velocity.bindStorage(DUST_BIND_VELOCITY);
  m_density.bindStorage(DUST_BIND_DENSITY);
  const int count = int(sources.size());
  m_addSources.set(DUST_UNIFORM_A, count);
  m_addSources.run((count + kListGroup - 1) / kListGroup);
}

void GlDust::addForces(float dt) {
  setStep(dt);
  m_velocity.bindStorage(DUST_BIND_VELOCITY);
  m_work.bindStorage(DUST_BIND_VELOCITY_2);
  m_density.bindStorage(DUST_BIND_DENSITY);
  if (m_def.vorticity > 0) m_source.runOnCells(m_curl);
  m_source.runOnCells(m_forces);
}

void GlDust::placeObstacles(std::span<const SolidCells> solids) {
  m_params.bindBase(GL_UNIFORM_BUFFER, DUST_BIND_PARAMS);
  if (!solids.empty() || m_anySolid) {
    m_solidList.clear();
    for (const SolidCells& s : solids) m_solidList.push_back(s.solid);
    if (m_solidList.empty()) m_solidList.emplace_back();  // a binding must hold something; the count is 0
    sendList(std::span<const shared::DustSolid>(m_solidList));
    m_velocity.bindStorage(DUST_BIND_VELOCITY);
    m_air.bindStorage(DUST_BIND_AIR);
    m_obstacles.set(DUST_UNIFORM_A, int(solids.size()));
    m_source.runOnCells(m_obstacles);
  }
  m_anySolid = !solids.empty();
  m_pressure.setAir(m_air, m_anySolid);
}

void GlDust::computeDivergence() {
  m_params.bindBase(GL_UNIFORM_BUFFER, DUST_BIND_PARAMS);
  m_velocity.bindStorage(DUST_BIND_VELOCITY);
  m_air.bindStorage(DUST_BIND_AIR);
  m_faces.bindStorage(DUST_BIND_FACES);
  m_source.runOnCells(m_faceVelocities);
  m_divergence.bindStorage(DUST_BIND_RHS);
  m_source.runOnCells(m_divergenceOf);
}

void GlDust::solvePressure() {
  m_pressure.solve(m_divergence, m_def.pressureCycles);
}

void GlDust::project() {
  m_pressure.pressure().bindStorage(DUST_BIND_PRESSURE);
  m_velocity.bindStorage(DUST_BIND_VELOCITY_OUT);
  m_air.bindStorage(DUST_BIND_AIR);
  m_faces.bindStorage(DUST_BIND_FACES);
  m_source.runOnCells(m_projectFaces);
  m_source.runOnCells(m_projectCells);
}

void GlDust::advectVelocity(float dt) {
  setStep(dt);
  m_velocity.bindStorage(DUST_BIND_VELOCITY);
  m_work.bindStorage(DUST_BIND_VELOCITY_2);
  m_corrected.bindStorage(DUST_BIND_VELOCITY_OUT);
  m_source.runOnCells(m_advect);
  m_source.runOnCells(m_correct);
  std::swap(m_velocity, m_corrected);
}

void GlDust::transportDust(float dt) {
  setStep(dt);
  m_density.bindStorage(DUST_BIND_DENSITY);
  m_air.bindStorage(DUST_BIND_AIR);
  m_faces.bindStorage(DUST_BIND_FACES);
  m_substeps.bindStorage(DUST_BIND_LIST);
  m_source.runOnCells(m_courant);
  m_schedule.run(1);
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
  m_outflow.bindStorage(DUST_BIND_OUTFLOW);  // the binding point of the air, which is no longer needed
  for (int s = 0; s < shared::kDustMaxSubsteps; ++s) {
    // Every other substep takes the axes in reverse, which cancels the bias of their order.
    for (int k = 0; k < 3; ++k) {
      m_sweep.set(DUST_UNIFORM_A, s % 2 == 0 ? k : 2 - k);
      m_sweep.runIndirect(m_substeps.id(), std::size_t(s) * sizeof(shared::DustDispatch));
    }
  }
}

void GlDust::sumTotals() {
  m_totals.update(m_density, m_outflow, m_emitted, m_outside);
}

const gl::Buffer& GlDust::bufferOf(Field field) const {
  switch (field) {
    case Field::Velocity:
      return m_velocity;
    case Field::Density:
      return m_density;
    case Field::Air:
      return m_air;
    case Field::Faces:
      return m_faces;
    case Field::Divergence:
      return m_divergence;
    case Field::Pressure:
      break;
  }
  return m_pressure.pressure();
}

void GlDust::read(Field field, std::vector<float>& values) const {
  const gl::Guest guest(m_capabilities, gl::Visit::Copy);
  values.resize(valuesOf(field));
  bufferOf(field).read(std::as_writable_bytes(std::span(values)));
}

void GlDust::write(Field field, std::span<const float> values) {
  if (values.size() != valuesOf(field)) throw Error("dust: write: wrong number of values");
  if (field == Field::Pressure) throw Error("dust: write: the pressure is a result");
  const gl::Guest guest(m_capabilities);
  bufferOf(field).write(std::as_bytes(values));
  if (field != Field::Air) return;
  m_params.bindBase(GL_UNIFORM_BUFFER, DUST_BIND_PARAMS);
  m_anySolid = true;
  m_pressure.setAir(m_air, true);
}

}  // namespace rubble::dust

namespace rubble {

std::unique_ptr<DustGrid> createDustGridGl(const DustGridDef& def, const std::string& shaderDirectory) {
  return std::make_unique<dust::GlDust>(def, shaderDirectory);
}

}  // namespace rubble
