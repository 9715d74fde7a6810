// Cooking in tests, where a warning is a failure.
#pragma once

#include "rubble/cook.h"
#include "support/strict_log.h"

namespace rubble::test {

/// cook(); its warnings fail the running test.
inline Asset cookStrictly(const SurfaceMesh& mesh, const CookOptions& options) {
  return cook(mesh, options, {}, strictLog());
}

}  // namespace rubble::test
