// Grain of concrete and floor: a periodic volume of fractal value noise with its gradient.
#pragma once

#include "gl/name.h"

namespace rubble::render {

/// RGBA8, repeating, with mipmaps: rgb gradient, a value, all about one half. The same on every machine.
gl::TextureName makeNoiseTexture();

}  // namespace rubble::render
