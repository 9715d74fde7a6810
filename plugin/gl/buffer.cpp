#include "gl/buffer.h"

#include <algorithm>

#include "gl/error.h"

namespace rubble::gl {
namespace {

// Bytes move through this target, which no draw reads: the vertex array in use must not notice.
constexpr GLenum kTarget = GL_COPY_WRITE_BUFFER;
// No storage is smaller [bytes]: an empty list still needs something to bind.
constexpr std::size_t kLeastBytes = 16;

// What is done from here on comes after the update, on the GPU and without waiting here. GL promises that by
// itself; NVIDIA's 580 on an H100 lets shaders read what stood there before (the dust then has other
// constants than those of its step, and blows up), whatever the target, usage or glMemoryBarrier.
void orderAfterUpdate() {
  const GLsync update = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (update == nullptr) return;
  glWaitSync(update, 0, GL_TIMEOUT_IGNORED);
  glDeleteSync(update);
}

void bindForUpdate(GLuint id) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(kTarget, id);
}

}  // namespace

Buffer::Buffer(std::size_t bytes, GLenum usage) {
  allocate(bytes, usage);
  clear();
}

void Buffer::allocate(std::size_t bytes, GLenum usage) {
  if (m_name.id() == 0) {
    GLuint id = 0;
    glGenBuffers(1, &id);
    m_name = BufferName(id);
  }
  m_bytes = 0;  // until the driver has agreed
  glBindBuffer(kTarget, m_name.id());
  glBufferData(kTarget, GLsizeiptr(bytes), nullptr, usage);
  checkGl("storage for a buffer");
  m_bytes = bytes;
}

void Buffer::upload(std::span<const std::byte> contents, GLenum usage) {
  if (contents.size() > m_bytes || m_bytes == 0) {
    // Half as much again, so that a growing list does not ask for storage every frame.
    const std::size_t wanted = m_bytes == 0 ? contents.size() : contents.size() + contents.size() / 2;
    allocate(std::max(wanted, kLeastBytes), usage);
  }
  if (!contents.empty()) write(contents);
}

void Buffer::write(std::span<const std::byte> contents, std::size_t offset) const {
  bindForUpdate(m_name.id());
  glBufferSubData(kTarget, GLintptr(offset), GLsizeiptr(contents.size()), contents.data());
  orderAfterUpdate();
}

void Buffer::read(std::span<std::byte> contents) const {
  bindForUpdate(m_name.id());
  glGetBufferSubData(kTarget, 0, GLsizeiptr(contents.size()), contents.data());
}

void Buffer::clear() const {
  bindForUpdate(m_name.id());
  glClearBufferData(kTarget, GL_R32F, GL_RED, GL_FLOAT, nullptr);
  orderAfterUpdate();
}

void Buffer::bindBase(GLenum target, GLuint index) const {
  glBindBufferBase(target, index, m_name.id());
}

}  // namespace rubble::gl
