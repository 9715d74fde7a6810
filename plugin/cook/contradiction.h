// The one exception that stays inside the cook.
#pragma once

#include <stdexcept>

namespace rubble::cooking {

/// The diagram contradicts itself: rounding decided a nearly degenerate case differently in two cells
/// (another jitter of the sites cures that), or the mesh passes through itself (nothing does).
class Contradiction : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rubble::cooking
