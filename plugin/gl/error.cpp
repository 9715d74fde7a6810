#include "gl/error.h"

#include <epoxy/gl.h>

#include <string>

#include "rubble/machine_error.h"

namespace rubble::gl {
namespace {

constexpr int kMostErrors = 64;

}  // namespace

void discardErrors() {
  for (int i = 0; i < kMostErrors && glGetError() != GL_NO_ERROR; ++i) {
  }
}

void checkGl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  throw MachineError("OpenGL: " + std::string(what) + ": error " + std::to_string(error) +
                     (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

}  // namespace rubble::gl
