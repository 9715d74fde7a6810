// The frame of an asset: the mesh's own, or one nearer to the solid where floats would not hold its corners.
#pragma once

#include "cook/checked_mesh.h"
#include "rubble/cook.h"

namespace rubble::cooking {

/// Where the asset's frame starts in the mesh's coordinates [m]: zero, unless floats would miss the corners
/// by more than base::kSharpness of the elements' spacing, for a solid that lies farther from there than it
/// is large. Then about the middle of its bounds, rounded to a power of two, so that coordinates keep their
/// bits.
Eigen::Vector3d frameOrigin(const CheckedMesh& solid, const CookOptions& options);

/// The shape of the mesh in that frame, without its look.
SurfaceMesh moved(const SurfaceMesh& mesh, const Eigen::Vector3d& origin);

}  // namespace rubble::cooking
