#include "render/dust_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gl/shader.h"
#include "gl/texture.h"
#include "render/frame.h"

namespace rubble::render {
namespace {

GLuint groups(int items, int size) {
  return GLuint((items + size - 1) / size);
}

// Along the light: before the grid nothing has been lost, behind it the shadow goes on.
gl::TextureName makeCube(GLenum format, int n, GLenum edge, float border) {
  return gl::makeVolume({.format = format,
                         .size = n,
                         .edges = {edge, edge, GL_CLAMP_TO_EDGE},
                         .border = {border, border, border, border}});
}

}  // namespace

DustLightBox dustLightBox(const Eigen::AlignedBox3f& grid, const Eigen::Vector3f& toSun, int slices) {
  Eigen::Index axis = 0;
  toSun.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  const float sunny = toSun[axis] > 0 ? grid.max()[axis] : grid.min()[axis];
  const float down =
      (toSun[axis] > 0 ? -1.f : 1.f) / grid.sizes()[axis];  // third coordinate per metre along the axis
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m(2, axis) = down;
  m(2, 3) = -down * sunny;
  m(3, 3) = 1;
  // A point's first two coordinates are those of the place on the sunny side where its sunlight came in:
  // x_u + (sunny - x_axis) slope. They span the box's own extent and the slant's.
  for (int row = 0; row < 2; ++row) {
    const Eigen::Index a = row == 0 ? u : v;
    const float slope = toSun[a] / toSun[axis];
    const float slant = slope * (toSun[axis] > 0 ? 1.f : -1.f) * grid.sizes()[axis];
    const float low = grid.min()[a] + std::min(slant, 0.f);
    const float extent = grid.sizes()[a] + std::abs(slant);
    m(row, a) = 1 / extent;
    m(row, axis) = -slope / extent;
    m(row, 3) = (sunny * slope - low) / extent;
  }
  const float stride = grid.sizes()[axis] / (std::abs(toSun[axis]) * float(slices));
  return {m, Eigen::Matrix4f(m.cast<double>().inverse().cast<float>()), stride};
}

DustVolume::DustVolume(const std::string& shaderDirectory)
    : m_extinctionProgram(
          gl::makeProgram(shaderDirectory, {{GL_COMPUTE_SHADER, "draw/dust_extinction.comp"}})),
      m_lightProgram(gl::makeProgram(shaderDirectory, {{GL_COMPUTE_SHADER, "draw/dust_light.comp"}})) {}

void DustVolume::resize(int resolution) {
  if (resolution == m_resolution) return;
  m_extinction = makeCube(GL_R32F, resolution, GL_CLAMP_TO_EDGE, 0);
  m_light = makeCube(GL_RG16F, resolution, GL_CLAMP_TO_BORDER, 1);
  m_resolution = resolution;
}

bool DustVolume::update(const DustGrid& grid, const DustLook& look) {
  const int n = grid.def().resolution;
  resize(n);
  if (grid.densityBuffer() != 0) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_DENSITY_BUFFER, grid.densityBuffer());
  } else {
    grid.readDensity(m_cpuDensity);
    if (m_cpuDensity.size() != grid.cellCount())
      throw Error("Renderer::setDust: the grid's density has a wrong size");
    if (std::none_of(m_cpuDensity.begin(), m_cpuDensity.end(), [](float d) { return d > 0; })) return false;
    m_density.upload(std::span<const float>(m_cpuDensity), GL_STREAM_DRAW);
    m_density.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_DENSITY_BUFFER);
  }
  const auto top = std::uint32_t(n);
  const std::array<std::uint32_t, 8> empty{top, top, top, 0, 0, 0, 0, 0};
  m_bounds.upload(std::span<const std::uint32_t>(empty), GL_DYNAMIC_DRAW);
  m_bounds.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_DUST_BOUNDS_BUFFER);
  glUseProgram(m_extinctionProgram.id());
  glUniform4i(RUBBLE_GRID_UNIFORM, n, 0, 0, 0);
  glUniform1f(RUBBLE_EXTINCTION_UNIFORM,
              massExtinction(grid.def().grainDensity, grid.def().grainRadius) * look.opacity);
  glBindImageTexture(RUBBLE_EXTINCTION_IMAGE, m_extinction.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
  glDispatchCompute(groups(n, RUBBLE_COPY_GROUP_X), groups(n, RUBBLE_COPY_GROUP_Y), top);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return true;
}

void DustVolume::describe(const DustGrid& grid, const DustLook& look, int steps, shared::Frame& frame) const {
  const Eigen::Vector3f low = grid.def().min, high = grid.def().max;
  const DustLightBox box =
      dustLightBox(Eigen::AlignedBox3f(low, high), frame.sunDirection.head<3>(), m_resolution);
  frame.worldToDustLight = box.worldToLight;
  frame.dustLightToWorld = box.lightToWorld;
  frame.dustMin = withW(low, float(steps));
  frame.dustMax = withW(high, 1);
  frame.dustColour = withW(look.colour, box.stride);
}

void DustVolume::light() const {
  glUseProgram(m_lightProgram.id());
  glUniform4i(RUBBLE_GRID_UNIFORM, m_resolution, 0, 0, 0);
  glActiveTexture(GL_TEXTURE0 + RUBBLE_EXTINCTION_UNIT);
  glBindTexture(GL_TEXTURE_3D, m_extinction.id());
  glBindImageTexture(RUBBLE_DUST_LIGHT_IMAGE, m_light.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RG16F);
  glDispatchCompute(groups(m_resolution, RUBBLE_LIGHT_GROUP), groups(m_resolution, RUBBLE_LIGHT_GROUP), 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glActiveTexture(GL_TEXTURE0 + RUBBLE_DUST_LIGHT_UNIT);
  glBindTexture(GL_TEXTURE_3D, m_light.id());
}

void DustVolume::bind() const {
  m_bounds.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_DUST_BOUNDS_BUFFER);
  glUniform4i(RUBBLE_GRID_UNIFORM, m_resolution, 0, 0, 0);
}

}  // namespace rubble::render
