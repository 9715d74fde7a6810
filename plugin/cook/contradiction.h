// The exceptions that stay inside the cook.
#pragma once

#include <stdexcept>

#include "rubble/error.h"

namespace rubble::cooking {

/// The diagram contradicts itself: rounding decided a nearly degenerate case differently in two cells
/// (another jitter of the sites cures that), or the mesh passes through itself (nothing does).
class Contradiction : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No jitter cured the contradictions.
class NotCut : public Error {
 public:
  using Error::Error;
};

}  // namespace rubble::cooking
