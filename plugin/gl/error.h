// Errors that OpenGL has recorded.
#pragma once

namespace rubble::gl {

/// Throws rubble::Error, naming `what`, when GL has recorded an error.
void checkGl(const char* what);

}  // namespace rubble::gl
