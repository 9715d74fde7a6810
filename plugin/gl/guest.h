// Rubble is a guest in the caller's OpenGL context: what it does depends on none of the caller's state, and
// the caller finds that state again.
#pragma once

#include <memory>

namespace rubble::gl {

struct Capabilities;

/// What is about to be done.
enum class Visit {
  Copy,        ///< bytes into and out of buffers (gl::Buffer) and nothing else
  Everything,  ///< objects are made, pixels read, triangles drawn, kernels run
};

/// While it lives the context is in a state that this folder alone decides: OpenGL's defaults (pixel_store.h,
/// raster.h) and nothing bound that gets between (bindings.h). Its end sets the caller's state again.
///
/// Errors that the caller has not fetched are discarded at the beginning, so that checkGl() only ever sees
/// ours, and what is left of ours at the end.
///
/// A transform feedback in progress is paused meanwhile. A conditional render in progress is ended for good:
/// OpenGL does not tell which it was. Queries in progress count what is drawn.
class Guest {
 public:
  explicit Guest(const Capabilities& capabilities, Visit visit = Visit::Everything);
  ~Guest();
  Guest(const Guest&) = delete;
  Guest& operator=(const Guest&) = delete;

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace rubble::gl
