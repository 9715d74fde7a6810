#include "bullet/whole_shapes.h"

#include <algorithm>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Sums of masses of other densities differ by their rounding, by far less than this share.
constexpr double kSameMasses = 1e-9;

bool areAlike(const MassFrame& a, const MassFrame& b, double diagonal) {
  return (a.centre - b.centre).norm() < kSameMasses * diagonal &&
         (a.inertia / a.mass - b.inertia / b.mass).norm() < kSameMasses * diagonal * diagonal;
}

}  // namespace

WholeShapes::OfAsset& WholeShapes::find(const std::shared_ptr<const Asset>& asset) {
  std::erase_if(m_assets, [](const OfAsset& known) { return known.owner.expired(); });
  const auto found = std::ranges::find_if(m_assets, [&](const OfAsset& known) {
    return known.asset == asset.get() && !known.owner.owner_before(asset) && !asset.owner_before(known.owner);
  });
  if (found != m_assets.end()) return *found;
  return m_assets.emplace_back(OfAsset{asset, asset.get(), solidHullsOf(*asset), {}});
}

WholeShape WholeShapes::of(const std::shared_ptr<const Asset>& asset, std::span<const double> masses,
                           std::span<const double> inertias) {
  OfAsset& known = find(asset);
  const MassFrame frame = massFrameOf(*asset, masses, inertias);
  const double diagonal = asset->diagonal();
  const auto alike = std::ranges::find_if(
      known.made, [&](const Made& made) { return areAlike(made.masses, frame, diagonal); });
  if (alike == known.made.end())
    return known.made.emplace_back(Made{frame, wholeShape(*asset, known.solid, frame)}).whole;
  WholeShape whole = alike->whole;
  whole.inertia *= btScalar(frame.mass / whole.mass);
  whole.mass = frame.mass;
  return whole;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
