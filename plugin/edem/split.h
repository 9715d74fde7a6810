// A fragment that becomes a body of its own. It has the constants and the numbers of the one that it comes
// from: element i and spring s are the same in both, in one of them each.
#pragma once

#include <cstdint>
#include <vector>

#include "edem/body.h"

namespace rubble::edem {

/// Whether the fragment with this lowest element may: no anchor holds it, it does not sleep, and it is not
/// all that the body has.
template <class Real>
bool maySplit(const Body<Real>& body, std::uint32_t root);

/// 1 for the elements of that fragment (n).
template <class Real>
std::vector<std::uint8_t> membersOf(const Body<Real>& body, std::uint32_t root);

/// Takes the members of such a fragment out of the body. Places, motion, cracks and what its springs hold
/// stay bit by bit; nothing is booked, for the sums over both are what they were.
template <class Real>
Body<Real> splitOff(Body<Real>& body, const std::vector<std::uint8_t>& members, std::uint32_t id);

}  // namespace rubble::edem
