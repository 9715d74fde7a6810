// The OpenGL context of the tests. A machine that has none skips them, and each says why.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "demo/window/egl_context.h"
#include "rubble/error.h"

namespace rubble::test {

/// A current OpenGL 4.3 context, which can compute; null where there is none, and then `reason` tells why.
inline std::unique_ptr<demo::EglContext> tryContext(std::string& reason) {
  // Looked for first: without the library epoxy ends the process.
  if (dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL) == nullptr) {
    reason = dlerror();
    return nullptr;
  }
  try {
    return std::make_unique<demo::EglContext>();
  } catch (const Error& error) {
    reason = error.what();
    return nullptr;
  }
}

/// For tests whose subject makes its own context: why it will not get one, empty when it will.
inline std::string whyNoContext() {
  std::string reason;
  tryContext(reason);
  return reason;
}

/// One context for all tests of a suite.
class GlTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { s_context = tryContext(s_reason); }
  static void TearDownTestSuite() { s_context.reset(); }

  void SetUp() final {
    if (!s_context) GTEST_SKIP() << "no OpenGL context: " << s_reason;
    prepare();
  }
  /// In place of SetUp: runs with the context current.
  virtual void prepare() {}

 private:
  static inline std::unique_ptr<demo::EglContext> s_context;
  static inline std::string s_reason;
};

}  // namespace rubble::test
