// A buffer and the moving of bytes in and out of it.
#pragma once

#include <cstddef>
#include <span>

#include "gl/name.h"

namespace rubble::gl {

/// Of a fixed size, or growing by upload(). Whatever shaders wrote is there before GL copies, clears,
/// overwrites or reads it.
class Buffer {
 public:
  Buffer() = default;
  /// Of so many bytes, all zero. Throws rubble::Error when the driver has no memory for them.
  explicit Buffer(std::size_t bytes, GLenum usage = GL_DYNAMIC_COPY);

  /// Replaces the contents. Keeps the storage where it is large enough, else asks for half as much again as
  /// is needed. Throws rubble::Error when the driver has no memory for it.
  void upload(std::span<const std::byte> contents, GLenum usage);
  template <class T>
  void upload(std::span<const T> items, GLenum usage) {
    upload(std::as_bytes(items), usage);
  }

  /// Overwrites bytes from `offset` on, within the storage.
  void write(std::span<const std::byte> contents, std::size_t offset = 0) const;
  /// Copies the first bytes out; waits for the GPU.
  void read(std::span<std::byte> contents) const;
  void clear() const;  ///< to zeros

  void bindBase(GLenum target, GLuint index) const;
  void bindStorage(GLuint index) const { bindBase(GL_SHADER_STORAGE_BUFFER, index); }

  GLuint id() const { return m_name.id(); }
  std::size_t bytes() const { return m_bytes; }  ///< of storage

 private:
  void allocate(std::size_t bytes, GLenum usage);

  BufferName m_name;
  std::size_t m_bytes = 0;
};

/// Room for `count` items, all bits zero.
template <class T>
Buffer bufferOf(std::size_t count) {
  return Buffer(count * sizeof(T));
}

}  // namespace rubble::gl
