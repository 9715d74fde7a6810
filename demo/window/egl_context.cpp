#include "demo/window/egl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <optional>

#include "demo/window/egl_devices.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

// Looked for first: where a library is missing epoxy ends the process at its first call.
void requireLibraries() {
  const auto isThere = [](const char* name) { return dlopen(name, RTLD_LAZY | RTLD_LOCAL) != nullptr; };
  if (!isThere("libEGL.so.1")) throw MachineError("libEGL.so.1 cannot be loaded");
  if (!isThere("libGL.so.1") && !isThere("libOpenGL.so.0"))
    throw MachineError("neither libGL.so.1 nor libOpenGL.so.0 can be loaded");
}

bool hasClientExtension(const char* name) {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

std::vector<EGLDeviceEXT> listDevices() {
  std::vector<EGLDeviceEXT> devices;
  const bool canList =
      hasClientExtension("EGL_EXT_device_base") ||
      (hasClientExtension("EGL_EXT_device_enumeration") && hasClientExtension("EGL_EXT_device_query"));
  if (!canList || !hasClientExtension("EGL_EXT_platform_device")) return devices;
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count)) return devices;
  devices.resize(std::size_t(count));
  if (!eglQueryDevicesEXT(count, devices.data(), &count)) count = 0;
  devices.resize(std::size_t(count));
  return devices;
}

std::vector<EglDevice> describe(const std::vector<EGLDeviceEXT>& devices) {
  std::vector<EglDevice> descriptions;
  for (EGLDeviceEXT device : devices) {
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    descriptions.push_back({extensions ? extensions : ""});
  }
  return descriptions;
}

EGLDisplay openDisplay(const EglDisplayChoice& choice, const std::vector<EGLDeviceEXT>& devices) {
  switch (choice.kind) {
    case EglDisplayChoice::Kind::Device:
      return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[choice.device], nullptr);
    case EglDisplayChoice::Kind::Surfaceless:
      return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    case EglDisplayChoice::Kind::Default:
      break;
  }
  return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

// A context, current on this thread. Displays are shared by all who ask for them and stay initialised.
struct Opened {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  const char* problem = nullptr;  // why there is none
};

Opened open(EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return {.problem = "no display"};
  if (!eglBindAPI(EGL_OPENGL_API)) return {.problem = "no OpenGL"};
  const EGLint configs[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, configs, &config, 1, &count) || count == 0)
    return {.problem = "no configuration"};
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return {.problem = "no OpenGL 4.3 core context"};
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    return {.problem = "the context cannot be used without a surface"};
  }
  return {.display = display, .context = context};
}

}  // namespace

EglContext::EglContext() {
  requireLibraries();
  const std::vector<EGLDeviceEXT> devices = listDevices();
  std::string problem;  // of the last display, the one that most machines have
  for (const EglDisplayChoice& choice :
       displayChoices(describe(devices), hasClientExtension("EGL_MESA_platform_surfaceless"))) {
    const Opened opened = open(openDisplay(choice, devices));
    if (!opened.problem) {
      m_display = opened.display;
      m_context = opened.context;
      const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
      m_renderer = name ? name : "unknown";
      return;
    }
    problem = std::string(opened.problem) + " (error " + std::to_string(eglGetError()) + ")";
  }
  throw MachineError("EGL: " + problem);
}

EglContext::~EglContext() {
  eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(m_display, m_context);
}

}  // namespace rubble::demo
