// Textures in two and three dimensions.
#pragma once

#include <array>

#include "gl/name.h"

namespace rubble::gl {

/// A two-dimensional texture with one level. Filter by the caller's choice, edges clamped.
struct TextureDef {
  GLenum format;
  int width, height;  ///< texels
  GLenum filter = GL_NEAREST;
  int samples = 1;
};
/// Leaves it bound. Throws rubble::Error when the driver has no memory for it.
TextureName makeTexture2d(const TextureDef& def);

/// A cube of texels, linearly filtered.
struct VolumeDef {
  GLenum format;
  int size;  ///< texels along a side
  int levels = 1;
  std::array<GLenum, 3> edges{GL_REPEAT, GL_REPEAT, GL_REPEAT};  ///< along s, t, r
  std::array<float, 4> border{0, 0, 0, 0};
};
/// Leaves it bound. Throws rubble::Error when the driver has no memory for it.
TextureName makeVolume(const VolumeDef& def);

}  // namespace rubble::gl
