// Cases that break the promise, and are known to.
#pragma once

#include <array>

namespace rubble::stability {

struct KnownFault {
  int number;  ///< of the case
  const char* what;
};

/// A case that holds again leaves the list: tests/stability fails until it does.
inline constexpr std::array<KnownFault, 0> kKnownFaults = {};

/// Null: none is known of that case.
constexpr const char* knownFault(int number) {
  for (const KnownFault& fault : kKnownFaults)
    if (fault.number == number) return fault.what;
  return nullptr;
}

}  // namespace rubble::stability
