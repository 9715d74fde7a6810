#include "render/gl_object.h"

#include <array>
#include <string>

#include "rubble/machine_error.h"

namespace rubble::render {
namespace {

// Uploads go through this target: the vertex array in use must not notice.
constexpr GLenum kUploadTarget = GL_COPY_WRITE_BUFFER;
constexpr int kMaxColours = 4;

}  // namespace

void deleteBuffer(GLuint id) {
  glDeleteBuffers(1, &id);
}
void deleteTexture(GLuint id) {
  glDeleteTextures(1, &id);
}
void deleteVertexArray(GLuint id) {
  glDeleteVertexArrays(1, &id);
}
void deleteFramebuffer(GLuint id) {
  glDeleteFramebuffers(1, &id);
}
void deleteProgram(GLuint id) {
  glDeleteProgram(id);
}
void deleteShader(GLuint id) {
  glDeleteShader(id);
}

TextureName makeTexture() {
  GLuint id = 0;
  glGenTextures(1, &id);
  return TextureName(id);
}

VertexArrayName makeVertexArray() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return VertexArrayName(id);
}

FramebufferName makeFramebuffer() {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  return FramebufferName(id);
}

void Buffer::upload(std::span<const std::byte> bytes, GLenum usage) {
  if (m_name.id() == 0) {
    GLuint id = 0;
    glGenBuffers(1, &id);
    m_name = GlName<deleteBuffer>(id);
  }
  glBindBuffer(kUploadTarget, m_name.id());
  if (bytes.size() > m_capacity || m_capacity == 0) {
    // Half as much again, so that a growing list does not ask for storage every frame; never empty, for
    // bindings.
    const std::size_t wanted = m_capacity == 0 ? bytes.size() : bytes.size() + bytes.size() / 2;
    m_capacity = wanted < 16 ? 16 : wanted;
    glBufferData(kUploadTarget, GLsizeiptr(m_capacity), nullptr, usage);
    checkGl("storage for a buffer");
  }
  if (!bytes.empty()) glBufferSubData(kUploadTarget, 0, GLsizeiptr(bytes.size()), bytes.data());
}

void Buffer::write(std::size_t offset, std::span<const std::byte> bytes) {
  glBindBuffer(kUploadTarget, m_name.id());
  glBufferSubData(kUploadTarget, GLintptr(offset), GLsizeiptr(bytes.size()), bytes.data());
}

void Buffer::bindBase(GLenum target, GLuint index) const {
  glBindBufferBase(target, index, m_name.id());
}

TextureName makeTexture2d(const TextureDef& def) {
  TextureName texture = makeTexture();
  if (def.samples > 1) {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.id());
    glTexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, def.samples, def.format, def.width, def.height,
                              GL_TRUE);
  } else {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, def.format, def.width, def.height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GLint(def.filter));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GLint(def.filter));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  checkGl("a texture");
  return texture;
}

FramebufferName makeFramebuffer(const char* what, std::span<const GLuint> colours, GLuint depth,
                                int samples) {
  FramebufferName framebuffer = makeFramebuffer();
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
    throw MachineError(std::string("render: the framebuffer of ") + what + " is not complete (status " +
                       std::to_string(status) + ")");
  }
  return framebuffer;
}

void checkGl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  throw MachineError(std::string("render: ") + what + ": OpenGL error " + std::to_string(error) +
                     (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

}  // namespace rubble::render
