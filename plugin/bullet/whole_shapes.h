// The shapes of whole bodies, made once an asset.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bullet/whole_shape.h"
#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Bodies of one asset share Bullet's shapes where their masses are spread alike, whatever the density. A
/// body keeps what it has been given; the asset's own are kept until nobody has the asset any more.
class WholeShapes {
 public:
  /// As wholeShape.
  WholeShape of(const std::shared_ptr<const Asset>& asset, std::span<const double> masses,
                std::span<const double> inertias);
  std::size_t assetCount() const { return m_assets.size(); }

 private:
  struct Made {
    MassFrame masses;
    WholeShape whole;
  };
  struct OfAsset {
    std::weak_ptr<const Asset> owner;
    const Asset* asset;  ///< compared only: one owner may have several
    SolidHulls solid;
    std::vector<Made> made;
  };
  OfAsset& find(const std::shared_ptr<const Asset>& asset);

  std::vector<OfAsset> m_assets;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
