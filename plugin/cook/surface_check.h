// Faults of a closed surface that its edges do not show: where it is not known what is inside.
#pragma once

#include <Eigen/Core>
#include <string>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

/// Throws rubble::Error, with the place and what to do: the surface passes through itself, two sheets of it
/// lie in the same place and face the same way, a part within another faces the same way, a part that faces
/// inwards lies in none.
void checkSurface(const CheckedMesh& mesh);

/// Why a solid that passed the check could not be cut into cells: where it touches itself; empty: nowhere.
/// `origin`: of its coordinates, in the mesh's [m].
std::string whyNotCut(const CheckedMesh& mesh, const Eigen::Vector3d& origin);

}  // namespace rubble::cooking
