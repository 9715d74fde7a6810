#include "gl/raster.h"

#include "gl/capabilities.h"

namespace rubble::gl {
namespace {

// Off by default, but for GL_DITHER, which would make a picture depend on the driver.
constexpr std::array kOff{
    GL_COLOR_LOGIC_OP,
    GL_CULL_FACE,
    GL_DEPTH_CLAMP,
    GL_DEPTH_TEST,
    GL_DITHER,
    GL_FRAMEBUFFER_SRGB,
    GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_OFFSET_LINE,  // llvmpipe offsets filled polygons by it, too
    GL_POLYGON_OFFSET_POINT,
    GL_POLYGON_SMOOTH,
    GL_PRIMITIVE_RESTART,
    GL_PRIMITIVE_RESTART_FIXED_INDEX,
    GL_RASTERIZER_DISCARD,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_MASK,
    GL_SAMPLE_SHADING,
    GL_STENCIL_TEST,
};

void set(GLenum name, bool on) {
  (on ? glEnable : glDisable)(name);
}

}  // namespace

Raster::Raster(const Capabilities& capabilities)
    : m_clipControl(capabilities.clipControl),
      m_offsetClamp(capabilities.offsetClamp),
      m_windowRectangles(capabilities.windowRectangles) {
  saveSwitches(capabilities);
  for (GLuint i = 0; i < m_blend.size(); ++i) m_blend[i] = glIsEnabledi(GL_BLEND, i);
  for (GLuint i = 0; i < kColours; ++i) glGetBooleani_v(GL_COLOR_WRITEMASK, i, m_colourMasks[i].data());
  GLint viewports = 0;
  glGetIntegerv(GL_MAX_VIEWPORTS, &viewports);
  m_scissors.resize(std::size_t(viewports));
  for (GLuint i = 0; i < m_scissors.size(); ++i) m_scissors[i] = glIsEnabledi(GL_SCISSOR_TEST, i);
  glGetFloati_v(GL_VIEWPORT, 0, m_viewport.data());
  saveDepth();
  savePolygons();
  if (m_windowRectangles) saveRectangles();
  setDefaults();
}

void Raster::saveSwitches(const Capabilities& capabilities) {
  const auto save = [this](GLenum name) { m_switches.push_back({name, glIsEnabled(name)}); };
  for (const GLenum name : kOff) save(name);
  save(GL_MULTISAMPLE);
  GLint clips = 0;
  glGetIntegerv(GL_MAX_CLIP_DISTANCES, &clips);
  for (GLint i = 0; i < clips; ++i) save(GL_CLIP_DISTANCE0 + GLenum(i));
  for (const GLenum name : capabilities.extraSwitches) save(name);
}

void Raster::saveDepth() {
  glGetBooleanv(GL_DEPTH_WRITEMASK, &m_depthMask);
  glGetIntegerv(GL_DEPTH_FUNC, &m_depthFunction);
  glGetDoublei_v(GL_DEPTH_RANGE, 0, m_depthRange.data());
  if (!m_clipControl) return;
  glGetIntegerv(GL_CLIP_ORIGIN, &m_clipOrigin);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &m_clipDepth);
}

void Raster::savePolygons() {
  glGetIntegerv(GL_CULL_FACE_MODE, &m_cullFace);
  glGetIntegerv(GL_FRONT_FACE, &m_frontFace);
  glGetIntegerv(GL_POLYGON_MODE, m_polygonMode.data());
  glGetIntegerv(GL_PROVOKING_VERTEX, &m_provoking);
  glGetIntegerv(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, &m_derivatives);
  glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &m_offsetFactor);
  glGetFloatv(GL_POLYGON_OFFSET_UNITS, &m_offsetUnits);
  if (m_offsetClamp) glGetFloatv(GL_POLYGON_OFFSET_CLAMP, &m_offsetLimit);
}

void Raster::saveRectangles() {
  GLint count = 0;
  glGetIntegerv(GL_WINDOW_RECTANGLE_MODE_EXT, &m_rectangleMode);
  glGetIntegerv(GL_NUM_WINDOW_RECTANGLES_EXT, &count);
  m_rectangles.resize(std::size_t(count));
  for (GLuint i = 0; i < m_rectangles.size(); ++i)
    glGetIntegeri_v(GL_WINDOW_RECTANGLE_EXT, i, m_rectangles[i].corners.data());
}

void Raster::setDefaults() const {
  for (const Switch& s : m_switches) set(s.name, s.name == GL_MULTISAMPLE);
  for (GLuint i = 0; i < m_blend.size(); ++i) glDisablei(GL_BLEND, i);
  for (GLuint i = 0; i < kColours; ++i) {
    const GLboolean written = i < m_blend.size() ? GL_TRUE : GL_FALSE;
    glColorMaski(i, written, written, written, written);
  }
  glDisable(GL_SCISSOR_TEST);  // of all viewports: the first one alone is not enough for Mesa 22
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDepthRangeIndexed(0, 0, 1);
  if (m_clipControl) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  glHint(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_DONT_CARE);
  if (m_windowRectangles) glWindowRectanglesEXT(GL_EXCLUSIVE_EXT, 0, nullptr);
}

Raster::~Raster() {
  for (const Switch& s : m_switches) set(s.name, s.on == GL_TRUE);
  for (GLuint i = 0; i < m_blend.size(); ++i) (m_blend[i] == GL_TRUE ? glEnablei : glDisablei)(GL_BLEND, i);
  for (GLuint i = 0; i < kColours; ++i) {
    const auto& mask = m_colourMasks[i];
    glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
  }
  for (GLuint i = 0; i < m_scissors.size(); ++i)
    (m_scissors[i] == GL_TRUE ? glEnablei : glDisablei)(GL_SCISSOR_TEST, i);
  glViewportIndexedfv(0, m_viewport.data());
  glDepthMask(m_depthMask);
  glDepthFunc(GLenum(m_depthFunction));
  glDepthRangeIndexed(0, m_depthRange[0], m_depthRange[1]);
  if (m_clipControl) glClipControl(GLenum(m_clipOrigin), GLenum(m_clipDepth));
  glCullFace(GLenum(m_cullFace));
  glFrontFace(GLenum(m_frontFace));
  glPolygonMode(GL_FRONT_AND_BACK, GLenum(m_polygonMode[0]));
  glProvokingVertex(GLenum(m_provoking));
  glHint(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GLenum(m_derivatives));
  if (m_offsetClamp) {
    glPolygonOffsetClamp(m_offsetFactor, m_offsetUnits, m_offsetLimit);
  } else {
    glPolygonOffset(m_offsetFactor, m_offsetUnits);
  }
  if (m_windowRectangles)
    glWindowRectanglesEXT(GLenum(m_rectangleMode), GLsizei(m_rectangles.size()),
                          m_rectangles.empty() ? nullptr : m_rectangles[0].corners.data());
}

}  // namespace rubble::gl
