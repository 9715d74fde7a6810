#include "gl/bindings.h"

namespace rubble::gl {
namespace {

struct Target {
  GLenum target, binding;
};

// The general binding of the last two is changed by glBindBufferBase.
constexpr std::array<Target, 6> kBuffers{{
    {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
    {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
    {GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
    {GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING},
    {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING},
    {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING},
}};
constexpr std::array<Target, 3> kTextures{{
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
}};

struct IndexedTarget {
  GLenum target, binding, start, size;
};
constexpr IndexedTarget kStorage{GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING,
                                 GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE};
constexpr IndexedTarget kUniform{GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                                 GL_UNIFORM_BUFFER_SIZE};

template <class Range>
void save(const IndexedTarget& target, Range& bindings) {
  for (GLuint i = 0; i < bindings.size(); ++i) {
    glGetIntegeri_v(target.binding, i, &bindings[i].id);
    glGetInteger64i_v(target.start, i, &bindings[i].start);
    glGetInteger64i_v(target.size, i, &bindings[i].size);
  }
}

template <class Range>
void restore(const IndexedTarget& target, const Range& bindings) {
  for (GLuint i = 0; i < bindings.size(); ++i) {
    const auto& b = bindings[i];
    if (b.id == 0 || b.size == 0) {  // size 0: the whole buffer
      glBindBufferBase(target.target, i, GLuint(b.id));
    } else {
      glBindBufferRange(target.target, i, GLuint(b.id), GLintptr(b.start), GLsizeiptr(b.size));
    }
  }
}

}  // namespace

CopyBindings::CopyBindings() {
  glGetIntegerv(GL_COPY_READ_BUFFER_BINDING, &m_read);
  glGetIntegerv(GL_COPY_WRITE_BUFFER_BINDING, &m_write);
}

CopyBindings::~CopyBindings() {
  glBindBuffer(GL_COPY_READ_BUFFER, GLuint(m_read));
  glBindBuffer(GL_COPY_WRITE_BUFFER, GLuint(m_write));
}

Bindings::Bindings() {
  for (std::size_t i = 0; i < kBuffers.size(); ++i) glGetIntegerv(kBuffers[i].binding, &m_buffers[i]);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  save(kStorage, m_storage);
  save(kUniform, m_uniform);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &m_activeUnit);
  for (GLuint unit = 0; unit < kGuestUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    Unit& u = m_units[unit];
    for (std::size_t i = 0; i < kTextures.size(); ++i) glGetIntegerv(kTextures[i].binding, &u.textures[i]);
    glGetIntegerv(GL_SAMPLER_BINDING, &u.sampler);
    glBindSampler(unit, 0);
  }
  glActiveTexture(GL_TEXTURE0);
  for (GLuint i = 0; i < kGuestImages; ++i) {
    Image& image = m_images[i];
    glGetIntegeri_v(GL_IMAGE_BINDING_NAME, i, &image.id);
    glGetIntegeri_v(GL_IMAGE_BINDING_LEVEL, i, &image.level);
    glGetBooleani_v(GL_IMAGE_BINDING_LAYERED, i, &image.layered);
    glGetIntegeri_v(GL_IMAGE_BINDING_LAYER, i, &image.layer);
    glGetIntegeri_v(GL_IMAGE_BINDING_ACCESS, i, &image.access);
    glGetIntegeri_v(GL_IMAGE_BINDING_FORMAT, i, &image.format);
  }
  glGetIntegerv(GL_CURRENT_PROGRAM, &m_program);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &m_vertexArray);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &m_drawFramebuffer);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &m_readFramebuffer);
}

Bindings::~Bindings() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(m_readFramebuffer));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(m_drawFramebuffer));
  glBindVertexArray(GLuint(m_vertexArray));
  glUseProgram(GLuint(m_program));
  for (GLuint i = 0; i < kGuestImages; ++i) {
    const Image& image = m_images[i];
    glBindImageTexture(i, GLuint(image.id), image.level, image.layered, image.layer, GLenum(image.access),
                       GLenum(image.format));
  }
  for (GLuint unit = 0; unit < kGuestUnits; ++unit) {
    const Unit& u = m_units[unit];
    glActiveTexture(GL_TEXTURE0 + unit);
    for (std::size_t i = 0; i < kTextures.size(); ++i)
      glBindTexture(kTextures[i].target, GLuint(u.textures[i]));
    glBindSampler(unit, GLuint(u.sampler));
  }
  glActiveTexture(GLenum(m_activeUnit));
  restore(kUniform, m_uniform);
  restore(kStorage, m_storage);
  for (std::size_t i = 0; i < kBuffers.size(); ++i) glBindBuffer(kBuffers[i].target, GLuint(m_buffers[i]));
}

}  // namespace rubble::gl
