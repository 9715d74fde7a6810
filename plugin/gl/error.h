// Errors that OpenGL has recorded.
#pragma once

namespace rubble::gl {

/// Forgets errors that others have left: at most 64, for a lost context reports its loss without end.
void discardErrors();

/// Throws rubble::Error, naming `what`, when GL has recorded an error.
void checkGl(const char* what);

}  // namespace rubble::gl
