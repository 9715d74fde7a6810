// Owners of OpenGL names. Movable, not copyable; each needs the context it was made in when it is destroyed.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace rubble::gl {

/// Owns one name that Delete gives back; 0 is none.
template <void (*Delete)(GLuint)>
class Name {
 public:
  Name() = default;
  explicit Name(GLuint id) : m_id(id) {}
  ~Name() {
    if (m_id != 0) Delete(m_id);
  }
  Name(Name&& other) noexcept : m_id(std::exchange(other.m_id, 0)) {}
  Name& operator=(Name&& other) noexcept {
    std::swap(m_id, other.m_id);
    return *this;
  }
  GLuint id() const { return m_id; }

 private:
  GLuint m_id = 0;
};

inline void deleteBuffer(GLuint id) {
  glDeleteBuffers(1, &id);
}
inline void deleteTexture(GLuint id) {
  glDeleteTextures(1, &id);
}
inline void deleteVertexArray(GLuint id) {
  glDeleteVertexArrays(1, &id);
}
inline void deleteFramebuffer(GLuint id) {
  glDeleteFramebuffers(1, &id);
}
inline void deleteProgram(GLuint id) {
  glDeleteProgram(id);
}
inline void deleteShader(GLuint id) {
  glDeleteShader(id);
}

using BufferName = Name<deleteBuffer>;
using TextureName = Name<deleteTexture>;
using VertexArrayName = Name<deleteVertexArray>;
using FramebufferName = Name<deleteFramebuffer>;
using ProgramName = Name<deleteProgram>;
using ShaderName = Name<deleteShader>;

inline VertexArrayName makeVertexArray() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return VertexArrayName(id);
}

}  // namespace rubble::gl
