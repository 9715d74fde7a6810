// The one-line messages of the cook.
#pragma once

#include <sstream>
#include <string>

namespace rubble::cooking {

template <class... Parts>
std::string line(const Parts&... parts) {
  std::ostringstream text;
  text << "cook: ";
  (text << ... << parts);
  return text.str();
}

}  // namespace rubble::cooking
