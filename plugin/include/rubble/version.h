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
    {"float", 0x7d28a8883cf55c4f, 0x16d3e17185cedf13, 0x32b851828b9fe996},
    {"double", 0xcd9136d28d998ead, 0xd5cad4148684cc25, 0xa369848e9c5fe0f3},
};

}  // namespace rubble
