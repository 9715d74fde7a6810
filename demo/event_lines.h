// Events as JSON, one object a line.
#pragma once

#include <ostream>

#include "rubble/events.h"

namespace rubble::demo {

void writeEvents(std::ostream& out, int frame, const Events& events);

}  // namespace rubble::demo
