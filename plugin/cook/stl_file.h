// The binary form of STL: 80 bytes of anything, the number of triangles, and 50 bytes for each of them.
#pragma once

#include <optional>
#include <string>

#include "cook/polygon_file.h"

namespace rubble::cooking {

/// None if the bytes are the text form. Every triangle has three points of its own. Throws rubble::Error when
/// the file is shorter than its number of triangles says.
std::optional<PolygonSoup> parseBinaryStl(const std::string& bytes);

}  // namespace rubble::cooking
