// The dust grid as the renderer sees it: a texture of extinction, a light volume sheared along the sun's
// direction, and the box of cells that hold dust. Both back ends of the grid go the same way, through a
// buffer of densities.
#pragma once

#include <string>
#include <vector>

#include "gl/buffer.h"
#include "rubble/render.h"
#include "shared/draw.h"

namespace rubble::render {

/// The light volume of a grid box: world <-> [0, 1]^3, third axis from the sunny side on, and the length [m]
/// of one of `slices` steps along the light.
struct DustLightBox {
  Eigen::Matrix4f worldToLight;
  Eigen::Matrix4f lightToWorld;
  float stride;
};
DustLightBox dustLightBox(const Eigen::AlignedBox3f& grid, const Eigen::Vector3f& toSun, int slices);

class DustVolume {
 public:
  explicit DustVolume(const std::string& shaderDirectory);

  /// Fetches the grid's densities and fills extinction texture and bounds. Returns false when there is no
  /// dust to draw.
  bool update(const DustGrid& grid, const DustLook& look);
  /// Writes the dust's part of the frame block.
  void describe(const DustGrid& grid, const DustLook& look, int steps, shared::Frame& frame) const;
  /// Light through the dust; needs the frame block and the shadow map in place.
  void light() const;
  /// Textures, bounds and grid size for dust_march.frag, whose program is in use.
  void bind() const;

 private:
  void resize(int resolution);

  gl::ProgramName m_extinctionProgram, m_lightProgram;
  gl::TextureName m_extinction, m_light;
  gl::Buffer m_density, m_bounds;
  std::vector<float> m_cpuDensity;
  int m_resolution = 0;
};

}  // namespace rubble::render
