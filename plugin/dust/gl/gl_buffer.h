// Owner of a GL buffer of fixed size. Movable, not copyable; needs the context it was made in when it is
// destroyed.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>

namespace rubble::dust {

class GlBuffer {
 public:
  GlBuffer() = default;
  /// Filled with zeros. Throws rubble::Error when the driver has no memory for it.
  explicit GlBuffer(std::size_t bytes, GLenum usage = GL_DYNAMIC_COPY);
  ~GlBuffer();
  GlBuffer(GlBuffer&& other) noexcept;
  GlBuffer& operator=(GlBuffer&& other) noexcept;

  GLuint id() const { return m_id; }
  std::size_t bytes() const { return m_bytes; }
  void bind(GLuint index) const;  ///< as storage buffer
  void clear() const;             ///< to zeros
  void write(std::span<const std::byte> bytes) const;
  void read(std::span<std::byte> bytes) const;  ///< waits for the GPU

 private:
  GLuint m_id = 0;
  std::size_t m_bytes = 0;
};

template <class T>
GlBuffer bufferOf(std::size_t count) {
  return GlBuffer(count * sizeof(T));
}

/// Throws rubble::Error, naming `what`, when GL has recorded an error.
void checkGl(const char* what);

}  // namespace rubble::dust
