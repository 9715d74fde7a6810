#include "demo/window/egl_context.h"

#include <epoxy/egl.h>

#include <string>

#include "rubble/error.h"

namespace rubble::demo {
namespace {

Error failure(const char* what) {
  return Error(std::string("EGL: ") + what + " (error " + std::to_string(eglGetError()) + ")");
}

EGLDisplay openDisplay() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  }
  return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

}  // namespace

EglContext::EglContext() {
  m_display = openDisplay();
  EGLint major = 0, minor = 0;
  if (m_display == EGL_NO_DISPLAY || !eglInitialize(m_display, &major, &minor)) throw failure("no display");
  if (!eglBindAPI(EGL_OPENGL_API)) throw failure("no OpenGL");
  const EGLint configs[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(m_display, configs, &config, 1, &count) || count == 0)
    throw failure("no configuration");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  m_context = eglCreateContext(m_display, config, EGL_NO_CONTEXT, attributes);
  if (m_context == EGL_NO_CONTEXT) throw failure("no OpenGL 4.3 core context");
  if (!eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context)) {
    eglDestroyContext(m_display, m_context);
    throw failure("the context cannot be used without a surface");
  }
}

EglContext::~EglContext() {
  eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(m_display, m_context);
}

}  // namespace rubble::demo
