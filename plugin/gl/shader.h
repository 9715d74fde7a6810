// Shader files -> programs. `#include "shared/draw.h"` is spliced in, relative to the shader directory.
#pragma once

#include <initializer_list>
#include <string>

#include "gl/name.h"

namespace rubble::gl {

struct Stage {
  GLenum type;
  std::string file;          ///< relative to the shader directory
  std::string defines = {};  ///< lines put behind #version
};

/// Compiles and links. Throws rubble::Error with file name and the driver's log.
ProgramName makeProgram(const std::string& shaderDirectory, std::initializer_list<Stage> stages);

/// Text of a shader file with its includes spliced in. Throws rubble::Error for a missing file or includes
/// nested too deep.
std::string readShader(const std::string& shaderDirectory, const std::string& file);

}  // namespace rubble::gl
