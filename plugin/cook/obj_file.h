// OBJ files.
#pragma once

#include <string>

#include "cook/polygon_file.h"

namespace rubble::cooking {

/// The polygons of an OBJ file with their normals, texture coordinates and materials. Throws rubble::Error
/// that names the line which is wrong and what is allowed; whether the faces name what is there is not
/// checked.
PolygonSoup parseObj(const std::string& text);

}  // namespace rubble::cooking
