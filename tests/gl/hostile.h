// States of an OpenGL context that an application may leave behind, one kind a function, and a record of the
// state.
#pragma once

#include <map>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "gl/context.h"

namespace rubble::test {

/// One kind of state, set as badly as it goes. It may be set again in the same context.
struct Hostility {
  const char* name;
  void (*set)();
};
inline void PrintTo(const Hostility& kind, std::ostream* out) {
  *out << kind.name;
}

/// Those that the current OpenGL 4.3 may have; the last is all of them at once.
std::span<const Hostility> hostilities();
const Hostility& hostility(const std::string& name);

/// Everything that glGet and its like tell of what hostilities() set, by name; not the error.
std::map<std::string, std::vector<double>> stateOfContext();

/// A context of its own for each test, because their states would hurt those that follow.
class OwnContext {
 public:
  /// Fails the test where none can be made.
  OwnContext() {
    std::string reason;
    m_context = tryContext(reason);
    EXPECT_TRUE(m_context) << reason;
  }
  /// Ends a feedback in progress: drivers are known to let one outlive its context, and its buffer.
  ~OwnContext();
  OwnContext(const OwnContext&) = delete;
  OwnContext& operator=(const OwnContext&) = delete;

 private:
  std::unique_ptr<demo::EglContext> m_context;
};

}  // namespace rubble::test
