// Owners of OpenGL names. Movable, not copyable; each needs the context it was made in when it is destroyed.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

namespace rubble::render {

/// Owns one name that Delete gives back; 0 is none.
template <void (*Delete)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint id) : m_id(id) {}
  ~GlName() {
    if (m_id != 0) Delete(m_id);
  }
  GlName(GlName&& other) noexcept : m_id(std::exchange(other.m_id, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(m_id, other.m_id);
    return *this;
  }
  GLuint id() const { return m_id; }

 private:
  GLuint m_id = 0;
};

void deleteBuffer(GLuint id);
void deleteTexture(GLuint id);
void deleteVertexArray(GLuint id);
void deleteFramebuffer(GLuint id);
void deleteProgram(GLuint id);
void deleteShader(GLuint id);

using TextureName = GlName<deleteTexture>;
using VertexArrayName = GlName<deleteVertexArray>;
using FramebufferName = GlName<deleteFramebuffer>;
using ProgramName = GlName<deleteProgram>;
using ShaderName = GlName<deleteShader>;

TextureName makeTexture();
VertexArrayName makeVertexArray();
FramebufferName makeFramebuffer();

/// A buffer that grows: upload() replaces the contents and keeps the storage when it is large enough.
class Buffer {
 public:
  /// Throws rubble::Error when the driver has no memory for it.
  void upload(std::span<const std::byte> bytes, GLenum usage);
  template <class T>
  void upload(std::span<const T> items, GLenum usage) {
    upload(std::as_bytes(items), usage);
  }
  /// Overwrites bytes from `offset` on, within what upload() wrote.
  void write(std::size_t offset, std::span<const std::byte> bytes);
  void bindBase(GLenum target, GLuint index) const;
  GLuint id() const { return m_name.id(); }

 private:
  GlName<deleteBuffer> m_name;
  std::size_t m_capacity = 0;  // bytes
};

/// A two-dimensional texture with one level. Filtering and edges by the caller's choice.
struct TextureDef {
  GLenum format;
  int width, height;
  GLenum filter = GL_NEAREST;
  int samples = 1;
};
TextureName makeTexture2d(const TextureDef& def);

/// A framebuffer of these textures; `depth` may be 0. Throws rubble::Error, naming `what`, when it is not
/// complete.
FramebufferName makeFramebuffer(const char* what, std::span<const GLuint> colours, GLuint depth, int samples);

/// Throws rubble::Error, naming `what`, when GL has recorded an error.
void checkGl(const char* what);

}  // namespace rubble::render
