// Places of elements in a solid by other ways than the cook's.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cook/checked_mesh.h"

namespace rubble::test {

using Sites = std::vector<Eigen::Vector3d>;

/// A simple cubic lattice along the axes about the middle of the bounds, of the spacing that gives a number
/// near `count`; those of its places inside.
Sites cubicSites(const cooking::CheckedMesh& solid, std::size_t count);
/// The same of a face-centred cubic lattice, the densest packing.
Sites faceCentredSites(const cooking::CheckedMesh& solid, std::size_t count);
/// Independent of each other.
Sites randomSites(const cooking::CheckedMesh& solid, std::size_t count);
/// Random places moved to the centroids of their cells `iterations` times [Lloyd].
Sites lloydSites(const cooking::CheckedMesh& solid, std::size_t count, int iterations);

}  // namespace rubble::test
