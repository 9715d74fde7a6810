// What the solver's results are: they change only together with these numbers.
#pragma once

#include <cstdint>

namespace rubble {

/// FNV-1a over the bits of what a run of a scene gave, a hash a part.
struct SolverVersion {
  const char* precision;
  std::uint64_t world;   ///< elements, springs and Bullet's bodies after the last frame
  std::uint64_t debris;  ///< the pieces after the last frame
  std::uint64_t dust;    ///< what was emitted in all frames: each source, and their mass in the ledger
};

/// Of the blow of the scene `wall`, its cook included. A test runs the scene and compares
/// (tests/scenes/golden_test.cpp); a change that moves a bit updates them, and with them every table that
/// `rubble report` wrote.
inline constexpr SolverVersion kSolverVersions[] = {
    {"float", 0x38495dab8ee6fbff, 0xfc24c13e0566ac3e, 0xf50fe8f7ceadcac9},
    {"double", 0x8ae44dd4000edb82, 0xff7c6ffccf99d785, 0x9341aae2415029bd},
};

}  // namespace rubble
