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
    {"float", 0xd2addf224672771a, 0x5394fd8945514067, 0x4cb3e7324b24897b},
    {"double", 0x79c82adefc56134a, 0x9a4104722d99da7a, 0x12e42b5a8587fa2a},
};

}  // namespace rubble
