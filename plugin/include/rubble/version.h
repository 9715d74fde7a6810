// What the results of solver and cook are: they change only together with these numbers.
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
    {"float", 0x2bea32f29f71b3cf, 0x8789a5a790761e35, 0xd398490477914ab4},
    {"double", 0x8ae9bb2ea188e14e, 0x25df3814c0ef4499, 0x9ca92ce79943584d},
};

/// FNV-1a over what the cook makes of some solids, thick and thin: what was cooked by another version may
/// differ from what is cooked now, so caches of assets name this number. A test cooks them and compares
/// (tests/unit/cook/cook_version_test.cpp); a change that moves a bit updates it.
inline constexpr std::uint64_t kCookVersion = 0x3780862676598bb5;

}  // namespace rubble
