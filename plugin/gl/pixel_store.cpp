#include "gl/pixel_store.h"

#include "gl/capabilities.h"

namespace rubble::gl {
namespace {

struct Parameter {
  GLenum name;
  GLint value;  // OpenGL's default
};

// OpenGL 4.3, tables 8.1 and 18.1. The block sizes of compressed pixels are left: none are read or written.
constexpr std::array<Parameter, 16> kParameters{{
    {GL_PACK_SWAP_BYTES, 0},
    {GL_PACK_LSB_FIRST, 0},
    {GL_PACK_ROW_LENGTH, 0},
    {GL_PACK_IMAGE_HEIGHT, 0},
    {GL_PACK_SKIP_ROWS, 0},
    {GL_PACK_SKIP_PIXELS, 0},
    {GL_PACK_SKIP_IMAGES, 0},
    {GL_PACK_ALIGNMENT, 4},
    {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_LSB_FIRST, 0},
    {GL_UNPACK_ROW_LENGTH, 0},
    {GL_UNPACK_IMAGE_HEIGHT, 0},
    {GL_UNPACK_SKIP_ROWS, 0},
    {GL_UNPACK_SKIP_PIXELS, 0},
    {GL_UNPACK_SKIP_IMAGES, 0},
    {GL_UNPACK_ALIGNMENT, 4},
}};

}  // namespace

PixelStore::PixelStore(const Capabilities& capabilities) : m_packInvert(capabilities.packInvert) {
  for (std::size_t i = 0; i < kParameters.size(); ++i) {
    glGetIntegerv(kParameters[i].name, &m_values[i]);
    glPixelStorei(kParameters[i].name, kParameters[i].value);
  }
  if (!m_packInvert) return;
  glGetIntegerv(GL_PACK_INVERT_MESA, &m_invert);
  glPixelStorei(GL_PACK_INVERT_MESA, GL_FALSE);
}

PixelStore::~PixelStore() {
  for (std::size_t i = 0; i < kParameters.size(); ++i) glPixelStorei(kParameters[i].name, m_values[i]);
  if (m_packInvert) glPixelStorei(GL_PACK_INVERT_MESA, m_invert);
}

}  // namespace rubble::gl
