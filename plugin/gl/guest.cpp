#include "gl/guest.h"

#include <optional>

#include "gl/bindings.h"
#include "gl/capabilities.h"
#include "gl/error.h"
#include "gl/pixel_store.h"
#include "gl/raster.h"

namespace rubble::gl {
namespace {

// A conditional render would drop draws and dispatches. There is no asking whether one is in progress; ending
// none is an error, which must not reach the caller's debug log.
void endConditionalRender(const Capabilities& capabilities) {
  if (!capabilities.reportsErrors) return;
  const bool logs = glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE;
  if (logs) glDisable(GL_DEBUG_OUTPUT);
  glEndConditionalRender();
  discardErrors();
  if (logs) glEnable(GL_DEBUG_OUTPUT);
}

// While a feedback is active no program can be put to use.
class TransformFeedback {
 public:
  TransformFeedback() {
    GLboolean active = GL_FALSE, paused = GL_FALSE;
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    m_pausedHere = active == GL_TRUE && paused == GL_FALSE;
    if (m_pausedHere) glPauseTransformFeedback();
  }
  ~TransformFeedback() {
    if (m_pausedHere) glResumeTransformFeedback();
  }
  TransformFeedback(const TransformFeedback&) = delete;
  TransformFeedback& operator=(const TransformFeedback&) = delete;

 private:
  bool m_pausedHere = false;
};

struct All {
  explicit All(const Capabilities& capabilities) : pixels(capabilities), raster(capabilities) {}
  TransformFeedback feedback;  // first: goes on when the caller's program is back
  Bindings bindings;
  PixelStore pixels;
  Raster raster;
};

}  // namespace

struct Guest::State {
  CopyBindings copies;
  std::optional<All> all;
};

Guest::Guest(const Capabilities& capabilities, Visit visit) {
  discardErrors();
  if (visit == Visit::Everything) endConditionalRender(capabilities);
  m_state = std::make_unique<State>();
  if (visit == Visit::Everything) m_state->all.emplace(capabilities);
}

Guest::~Guest() {
  m_state.reset();
  discardErrors();
}

}  // namespace rubble::gl
