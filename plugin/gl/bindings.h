// What is bound where.
#pragma once

#include <epoxy/gl.h>

#include <array>

namespace rubble::gl {

/// Places below these numbers are given back as they were found; our shaders use no others.
constexpr GLuint kGuestUnits = 8;
constexpr GLuint kGuestStorageBuffers = 8;
constexpr GLuint kGuestUniformBuffers = 1;
constexpr GLuint kGuestImages = 2;

/// Gives back the buffers bound for copying, the only ones gl::Buffer's reads and writes bind.
class CopyBindings {
 public:
  CopyBindings();
  ~CopyBindings();
  CopyBindings(const CopyBindings&) = delete;
  CopyBindings& operator=(const CopyBindings&) = delete;

 private:
  GLint m_read = 0, m_write = 0;
};

/// Unbinds what would get between our calls and our objects: sampler objects, pixel buffers. Gives back all
/// that draws and kernels of ours bind.
class Bindings {
 public:
  Bindings();
  ~Bindings();
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

 private:
  struct Indexed {
    GLint id = 0;
    GLint64 start = 0, size = 0;
  };
  struct Unit {
    std::array<GLint, 3> textures{};
    GLint sampler = 0;
  };
  struct Image {
    GLint id = 0, level = 0, layer = 0, access = 0, format = 0;
    GLboolean layered = GL_FALSE;
  };

  std::array<GLint, 6> m_buffers{};
  std::array<Indexed, kGuestStorageBuffers> m_storage;
  std::array<Indexed, kGuestUniformBuffers> m_uniform;
  std::array<Unit, kGuestUnits> m_units;
  std::array<Image, kGuestImages> m_images;
  GLint m_activeUnit = 0, m_program = 0, m_vertexArray = 0, m_drawFramebuffer = 0, m_readFramebuffer = 0;
};

}  // namespace rubble::gl
