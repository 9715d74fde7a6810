#include "gl/framebuffer.h"

#include <array>
#include <cassert>
#include <string>

#include "rubble/machine_error.h"

namespace rubble::gl {
namespace {

constexpr std::size_t kMaxColours = 4;

}  // namespace

FramebufferName makeFramebuffer(const char* what, std::span<const GLuint> colours, GLuint depth,
                                int samples) {
  assert(colours.size() <= kMaxColours);
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  FramebufferName framebuffer(id);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  const GLenum target = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  std::array<GLenum, kMaxColours> buffers{};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    buffers[i] = GL_COLOR_ATTACHMENT0 + GLenum(i);
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers[i], target, colours[i], 0);
  }
  if (depth != 0) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, target, depth, 0);
  if (colours.empty()) {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  } else {
    glDrawBuffers(GLsizei(colours.size()), buffers.data());
  }
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw MachineError("OpenGL: the framebuffer of " + std::string(what) + " is not complete (status " +
                       std::to_string(status) + ")");
  }
  return framebuffer;
}

}  // namespace rubble::gl
