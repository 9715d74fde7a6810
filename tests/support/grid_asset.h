// Blocks of cubes, which the generated cases of demo/stability are made of too.
#pragma once

#include "demo/stability/grid_asset.h"

namespace rubble::test {

using stability::gridAsset;
using stability::GridAssetDef;

}  // namespace rubble::test
