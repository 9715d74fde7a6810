// The connected parts of a solid, and of its elements.
#pragma once

#include <cstddef>
#include <span>

#include "cook/checked_mesh.h"
#include "rubble/asset.h"

namespace rubble::cooking {

/// Parts of the solid that touch nowhere: its outer surfaces. A surface inside of another one and turned
/// inwards bounds a cavity.
std::size_t countParts(const CheckedMesh& mesh);

/// Into how many pieces the springs tie the elements.
std::size_t countTied(std::size_t elements, std::span<const AssetSpring> springs);

}  // namespace rubble::cooking
