// Cells as the asset keeps them: drawn triangles with normals, and faces for debris.
#pragma once

#include "cook/checked_mesh.h"
#include "cook/restricted_voronoi.h"
#include "cook/surface_look.h"

namespace rubble::cooking {

/// Takes the diagram, to free what is done with on the way. Fills vertices, corners, triangles, faces and
/// cells of the asset, and what the surface's look gives.
void buildCellMeshes(const CheckedMesh& mesh, const SurfaceLook& look, RestrictedVoronoi diagram,
                     Asset& asset);

}  // namespace rubble::cooking
