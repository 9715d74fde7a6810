// What lies between a triangle and its pixels, besides shaders and textures.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <vector>

namespace rubble::gl {

struct Capabilities;

/// Sets OpenGL's defaults, without dither: every fragment of a filled triangle is written, no depth test,
/// both faces, depth -1 to 1 onto 0 to 1. At the end sets the caller's.
///
/// Draws go to viewport 0 and draw buffers 0 and 1; other draw buffers are not written.
class Raster {
 public:
  explicit Raster(const Capabilities& capabilities);
  ~Raster();
  Raster(const Raster&) = delete;
  Raster& operator=(const Raster&) = delete;

 private:
  void saveSwitches(const Capabilities& capabilities);
  void saveDepth();
  void savePolygons();
  void saveRectangles();
  void setDefaults() const;

  struct Switch {
    GLenum name;
    GLboolean on;
  };
  struct Rectangle {
    std::array<GLint, 4> corners{};
  };
  static constexpr GLuint kColours = 8;  // draw buffers, the least that GL promises

  bool m_clipControl, m_offsetClamp, m_windowRectangles;  // what this context has
  std::vector<Switch> m_switches;
  std::array<GLboolean, 2> m_blend{};
  std::array<std::array<GLboolean, 4>, kColours> m_colourMasks{};
  std::vector<GLboolean> m_scissors;  // by viewport
  GLboolean m_depthMask = GL_TRUE;
  std::array<GLfloat, 4> m_viewport{};
  std::array<GLdouble, 2> m_depthRange{};
  GLint m_depthFunction = 0, m_cullFace = 0, m_frontFace = 0, m_provoking = 0, m_derivatives = 0;
  GLint m_clipOrigin = 0, m_clipDepth = 0;
  std::array<GLint, 2> m_polygonMode{};  // front and back; a core context may give the first alone
  GLfloat m_offsetFactor = 0, m_offsetUnits = 0, m_offsetLimit = 0;
  GLint m_rectangleMode = 0;
  std::vector<Rectangle> m_rectangles;
};

/// Draws go to the lower left of their target, of this many pixels.
inline void setViewport(int width, int height) {
  glViewportIndexedf(0, 0, 0, GLfloat(width), GLfloat(height));
}

}  // namespace rubble::gl
