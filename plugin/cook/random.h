// Random numbers with the same bits everywhere; the distributions of <random> differ between standard
// libraries.
#pragma once

#include <cstdint>

namespace rubble::cooking {

/// The output function of SplitMix64 [Steele14]: a bijection that passes as a hash of its argument.
inline std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : m_state(mix(seed)) {}

  /// In [0, 1), 53 bits.
  double uniform() {
    m_state += 0x9e3779b97f4a7c15u;
    return double(mix(m_state) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t m_state;
};

}  // namespace rubble::cooking
