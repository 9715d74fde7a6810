// What the current context can do.
#pragma once

#include <epoxy/gl.h>

#include <vector>

namespace rubble::gl {

/// Asked once, where something is made: asking for an extension walks through the list of all.
struct Capabilities {
  bool clipControl;       ///< glClipControl: 4.5 or GL_ARB_clip_control
  bool offsetClamp;       ///< glPolygonOffsetClamp: 4.6 or an extension
  bool packInvert;        ///< GL_MESA_pack_invert
  bool windowRectangles;  ///< GL_EXT_window_rectangles
  bool reportsErrors;     ///< false in a context made with KHR_no_error, where a wrong call is undefined
  /// Switches of extensions that change what is drawn, all off by default.
  std::vector<GLenum> extraSwitches;
};

/// Throws rubble::Error, which begins with `who`, unless an OpenGL 4.3 context is current.
Capabilities capabilitiesNow(const char* who);

}  // namespace rubble::gl
