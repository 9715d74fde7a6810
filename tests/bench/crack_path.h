// The easiest way for a crack through a solid: where springs hold least.
#pragma once

#include <Eigen/Core>
#include <utility>

#include "cook/checked_mesh.h"
#include "rubble/asset.h"

namespace rubble::test {

/// Area of the springs that the cheapest crack across `direction` (of unit length) breaks, over that of the
/// smallest flat section there. It may run anywhere within `band` [m] of the middle of the bounds. 1 where
/// there is a plane of weakness.
double crackRoughness(const Asset& asset, const cooking::CheckedMesh& solid, const Eigen::Vector3d& direction,
                      double band);

/// Of the area of all springs the largest share that faces one direction, within 10 degrees. 1 - cos(10
/// degrees), 1.5 %, where all directions are alike and there are many springs.
double shareOfOneDirection(const Asset& asset);

}  // namespace rubble::test
