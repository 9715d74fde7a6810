// Grain of concrete and floor: a periodic volume of fractal value noise with its gradient.
#pragma once

#include "render/gl_object.h"

namespace rubble::render {

/// RGBA8, repeating, with mipmaps: rgb gradient, a value, all about one half. The same on every machine.
TextureName makeNoiseTexture();

}  // namespace rubble::render
