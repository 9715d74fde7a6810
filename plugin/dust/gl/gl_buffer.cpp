#include "dust/gl/gl_buffer.h"

#include <string>
#include <utility>

#include "rubble/machine_error.h"

namespace rubble::dust {

namespace {

// Uploads go through this target, which no draw reads.
constexpr GLenum kTarget = GL_COPY_WRITE_BUFFER;

// What shaders wrote must arrive before GL itself copies, clears or overwrites it.
void bindForUpdate(GLuint id) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(kTarget, id);
}

}  // namespace

GlBuffer::GlBuffer(std::size_t bytes, GLenum usage) : m_bytes(bytes) {
  glGenBuffers(1, &m_id);
  glBindBuffer(kTarget, m_id);
  glBufferData(kTarget, GLsizeiptr(bytes), nullptr, usage);
  try {
    checkGl("storage for a buffer");
  } catch (...) {
    glDeleteBuffers(1, &m_id);
    throw;
  }
  clear();
}

GlBuffer::~GlBuffer() {
  if (m_id != 0) glDeleteBuffers(1, &m_id);
}

GlBuffer::GlBuffer(GlBuffer&& other) noexcept
    : m_id(std::exchange(other.m_id, 0)), m_bytes(std::exchange(other.m_bytes, 0)) {}

GlBuffer& GlBuffer::operator=(GlBuffer&& other) noexcept {
  std::swap(m_id, other.m_id);
  std::swap(m_bytes, other.m_bytes);
  return *this;
}

void GlBuffer::bind(GLuint index) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, index, m_id);
}

void GlBuffer::clear() const {
  bindForUpdate(m_id);
  glClearBufferData(kTarget, GL_R32F, GL_RED, GL_FLOAT, nullptr);
}

void GlBuffer::write(std::span<const std::byte> bytes) const {
  bindForUpdate(m_id);
  glBufferSubData(kTarget, 0, GLsizeiptr(bytes.size()), bytes.data());
}

void GlBuffer::read(std::span<std::byte> bytes) const {
  bindForUpdate(m_id);
  glGetBufferSubData(kTarget, 0, GLsizeiptr(bytes.size()), bytes.data());
}

void checkGl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  throw MachineError(std::string("dust: ") + what + ": OpenGL error " + std::to_string(error) +
                     (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
}

}  // namespace rubble::dust
