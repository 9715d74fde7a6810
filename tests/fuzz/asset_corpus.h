// Where the fuzzer begins: a few small assets with everything that a file can hold, of every version, and
// files that are refused for different reasons. Cubes alone: every number is exact, so every compiler makes
// the same bytes.
#pragma once

#include <map>
#include <string>

#include "fuzz/asset_input.h"
#include "support/grid_asset.h"
#include "unit/base/asset_old_bytes.h"

namespace rubble::test {

inline Asset cubeWithEverything() {
  Asset asset = gridAsset({{2, 1, 1}, 0.5, Eigen::Vector3d(1, 2, 3), true});
  asset.origin = Eigen::Vector3d(500'000, 0, 6'000'000);
  asset.uvs.assign(asset.corners.size(), Eigen::Vector2f(0.25f, -3));
  asset.materialNames = {"stone", ""};
  for (const Cell& cell : asset.cells) {
    asset.materials.insert(asset.materials.end(), cell.outerTriangles, 1);
    asset.materials.insert(asset.materials.end(), cell.innerTriangles, 2);
  }
  asset.preset = "brick_soft";
  asset.rest.emplace();
  asset.rest->key = 0x0123456789abcdefu;
  asset.rest->displacements.assign(asset.elementCount(), Eigen::Vector3d(0, -1e-4, -0.0));
  asset.rest->rotations.assign(asset.elementCount(), Eigen::Quaterniond(0.8, 0, 0.6, 0));
  return asset;
}

/// Name and bytes of every file; `scratch` is a file that may be written.
inline std::map<std::string, std::string> assetCorpus(const std::filesystem::path& scratch) {
  const auto saved = [&scratch](const Asset& asset) {
    save(asset, scratch);
    return bytesOf(scratch);
  };
  std::map<std::string, std::string> files;
  const Asset cube = gridAsset({{1, 1, 1}, 1, Eigen::Vector3d::Zero(), true});
  const Asset whole = cubeWithEverything();
  Asset rested = gridAsset({{1, 1, 1}, 1, Eigen::Vector3d::Zero(), true});
  rested.rest = {1, {Eigen::Vector3d::Zero()}, {Eigen::Quaterniond::Identity()}};
  const std::string bytes = saved(cube);
  files["cube"] = bytes;
  files["whole"] = saved(whole);
  files["pair"] = saved(gridAsset({{2, 1, 1}, 0.5, Eigen::Vector3d::Zero(), true}));
  files["version1"] = oldBytesOf(cube);
  files["version2"] = oldBytesOf(rested);
  files["version3"] = oldBytesOf(whole);
  files["version4"] = bytesWithoutOrigin(bytes);
  files["version5"] = bytesWithoutPreset(bytes);

  const auto damaged = [&bytes](std::size_t at, auto value) {
    std::string bad = bytes;
    setNumber(bad, at, value);
    seal(bad);
    return bad;
  };
  files["damaged_empty"] = "";
  files["damaged_magic"] = bytes.substr(0, 5);
  files["damaged_header_cut"] = bytes.substr(0, kHeaderBytes - 8);
  files["damaged_cut"] = bytes.substr(0, bytes.size() / 2);
  files["damaged_checksum"] = bytes;
  files["damaged_checksum"][kChecksumAt] ^= 1;
  files["damaged_version"] = damaged(kVersionAt, std::uint32_t(77));
  files["damaged_radius"] = damaged(kRadiusAt, 1e300);
  files["damaged_origin"] = damaged(kOriginAt, -1e300);
  files["damaged_preset"] = damaged(kPresetAt + 1, std::uint8_t('x'));
  files["damaged_count"] = damaged(kCountsAt + 8 * 3, ~std::uint64_t(0) / 20);
  files["damaged_counts_swapped"] = damaged(kCountsAt + 8 * 7, std::uint64_t(2));
  files["damaged_place"] = damaged(kHeaderBytes, std::uint64_t(0x7ff8000000000000));  // NaN
  files["damaged_end"] = bytes + std::string(8, 'x');
  return files;
}

}  // namespace rubble::test
