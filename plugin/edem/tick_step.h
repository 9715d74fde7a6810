// How long the substeps of a tick may be.
#pragma once

#include "edem/world.h"

namespace rubble::edem {

/// Longest safe step of a tick of `dt` as things are now [s]. Contacts that need a shorter one than
/// maxSubstepsPerFrame allows are made softer, then elements that still need one are frozen, and both are
/// told of; a tick that needs too many all the same fails.
template <class Real>
double longestStep(World<Real>& w, double dt);

/// Contacts have their stiffness again once none of those that were made softer is left.
template <class Real>
void hardenContacts(World<Real>& w);

}  // namespace rubble::edem
