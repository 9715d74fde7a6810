// A figure in a robe on a plinth, one arm up and the other on its hip: a free form for scenes.
#pragma once

#include "demo/implicit_mesh.h"

namespace rubble::demo {

/// The statue's distance, about: 1 m high, standing on y = 0 and looking along z.
double statueField(const Eigen::Vector3d& place);

/// The statue in the box of the given full edge lengths [m] about the origin; as wide and deep as it should
/// look where these are 0.49 and 0.34 of its height. One closed surface with one handle, the arm on the hip;
/// its foot is flat.
SurfaceMesh statueMesh(const Eigen::Vector3d& size);

}  // namespace rubble::demo
