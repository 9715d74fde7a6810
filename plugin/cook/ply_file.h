// PLY files.
#pragma once

#include <string>

#include "cook/polygon_file.h"

namespace rubble::cooking {

/// The polygons of a PLY file, as text or of either byte order, with the normals (nx, ny, nz) and texture
/// coordinates (s and t, u and v, or texture_u and texture_v) of its vertices and the texcoord lists of its
/// faces, which count where a face has both. Throws rubble::Error that names what is wrong; whether the faces
/// name what is there is not checked.
PolygonSoup parsePly(const std::string& bytes);

}  // namespace rubble::cooking
