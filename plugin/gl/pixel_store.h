// How pixels lie in memory when they are read and written.
#pragma once

#include <epoxy/gl.h>

#include <array>

namespace rubble::gl {

struct Capabilities;

/// Sets every glPixelStore parameter to OpenGL's default, and back to the caller's at the end.
class PixelStore {
 public:
  explicit PixelStore(const Capabilities& capabilities);
  ~PixelStore();
  PixelStore(const PixelStore&) = delete;
  PixelStore& operator=(const PixelStore&) = delete;

 private:
  bool m_packInvert;  // this context has GL_PACK_INVERT_MESA
  std::array<GLint, 16> m_values{};
  GLint m_invert = 0;
};

}  // namespace rubble::gl
