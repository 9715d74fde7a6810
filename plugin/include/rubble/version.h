// What the solver's results are: they change only together with these numbers.
#pragma once

#include <cstdint>

namespace rubble {

/// FNV-1a over the bits of elements, springs and Bullet's bodies after the blow of the scene `wall`, in both
/// precisions. A test runs the scene and compares (tests/scenes/golden_test.cpp); a change that moves a bit
/// updates them, and with them every table that `rubble report` wrote.
inline constexpr std::uint64_t kSolverVersionFloat = 0xd2addf224672771a;
inline constexpr std::uint64_t kSolverVersionDouble = 0x85ce41ca7df22158;

}  // namespace rubble
