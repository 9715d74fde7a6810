// What the cook made, to the last bit.
#pragma once

#include <string>
#include <type_traits>

#include "base/asset_format.h"
#include "base/hash.h"
#include "rubble/asset.h"

namespace rubble::test {

/// Adds every field of the asset, as its file holds them, and how many of each there are.
inline void addAsset(base::Fnv1a& hash, const Asset& asset) {
  const auto add = [&hash](const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      hash.add(value);
    } else {
      for (const auto number : value) hash.add(number);
    }
  };
  hash.add(asset.radius);
  if (!asset.origin.isZero(0)) hash.addAll(asset.origin);
  for (const std::size_t count :
       {asset.positions.size(), asset.springs.size(), asset.anchors.size(), asset.vertices.size(),
        asset.corners.size(), asset.triangles.size(), asset.faces.size(), asset.cells.size()})
    hash.add(count);
  const std::string names = base::nameBytesOf(asset);
  for (const std::size_t count : {asset.uvs.size(), asset.materials.size(), names.size()})
    if (count > 0) hash.add(count);
  base::visitAssetFields(asset, names, add);
}

}  // namespace rubble::test
