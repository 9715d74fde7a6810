#include "gl/capabilities.h"

#include <array>
#include <string>

#include "rubble/machine_error.h"

namespace rubble::gl {
namespace {

struct ExtraSwitch {
  const char* extension;
  GLenum name;
};

constexpr std::array kExtraSwitches{
    ExtraSwitch{"GL_EXT_depth_bounds_test", GL_DEPTH_BOUNDS_TEST_EXT},
    ExtraSwitch{"GL_EXT_raster_multisample", GL_RASTER_MULTISAMPLE_EXT},
    ExtraSwitch{"GL_NV_conservative_raster", GL_CONSERVATIVE_RASTERIZATION_NV},
    ExtraSwitch{"GL_INTEL_conservative_rasterization", GL_CONSERVATIVE_RASTERIZATION_INTEL},
    ExtraSwitch{"GL_NV_representative_fragment_test", GL_REPRESENTATIVE_FRAGMENT_TEST_NV},
    ExtraSwitch{"GL_NV_shading_rate_image", GL_SHADING_RATE_IMAGE_NV},
};

}  // namespace

Capabilities capabilitiesNow(const char* who) {
  const int version = epoxy_gl_version();
  if (version < 43 || !epoxy_is_desktop_gl()) {
    throw MachineError(std::string(who) + ": needs a current OpenGL 4.3 context, this one is " +
                       std::to_string(version / 10) + "." + std::to_string(version % 10));
  }
  const auto has = [](const char* extension) { return epoxy_has_gl_extension(extension); };
  GLint flags = 0;
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  Capabilities capabilities{
      .clipControl = version >= 45 || has("GL_ARB_clip_control"),
      .offsetClamp = version >= 46 || has("GL_ARB_polygon_offset_clamp"),
      .packInvert = has("GL_MESA_pack_invert"),
      .windowRectangles = has("GL_EXT_window_rectangles"),
      .reportsErrors = (GLuint(flags) & GL_CONTEXT_FLAG_NO_ERROR_BIT) == 0,
      .extraSwitches = {},
  };
  for (const ExtraSwitch& extra : kExtraSwitches) {
    if (has(extra.extension)) capabilities.extraSwitches.push_back(extra.name);
  }
  return capabilities;
}

}  // namespace rubble::gl
