// How often closed surfaces go round the two sides of each facet of theirs.
#pragma once

#include "cook/arrangement.h"

namespace rubble::cooking {

/// Fills in Facet::front and Facet::back.
void countWindings(Arrangement& arrangement);

}  // namespace rubble::cooking
