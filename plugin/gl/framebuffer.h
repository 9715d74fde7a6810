// Textures as the target of draws.
#pragma once

#include <span>

#include "gl/name.h"

namespace rubble::gl {

/// A framebuffer of these textures, at most four colours; `depth` may be 0. Leaves it bound. Throws
/// rubble::Error, naming `what`, when it is not complete.
FramebufferName makeFramebuffer(const char* what, std::span<const GLuint> colours, GLuint depth, int samples);

}  // namespace rubble::gl
