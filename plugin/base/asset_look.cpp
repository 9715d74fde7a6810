#include "base/asset_check.h"
#include "base/material_name.h"

namespace rubble::base {
namespace {

void checkLengthOrNone(std::size_t length, std::size_t due, const char* array, const char* each) {
  if (length != 0 && length != due)
    refuseAsset(array, " has ", length, " entries; allowed: none or one a ", each, ", ", due);
}

void checkNames(const Asset& asset) {
  if (asset.materialNames.size() > kMostMaterials)
    refuseAsset("materialNames has ", asset.materialNames.size(), " entries; allowed: up to ",
                kMostMaterials);
  for (std::size_t m = 0; m < asset.materialNames.size(); ++m)
    if (!isMaterialName(asset.materialNames[m]))
      refuseAsset("materialNames[", m, "] is no name; allowed: ", kMaterialNames);
}

void checkPreset(const Asset& asset) {
  if (asset.preset.size() > kMostPresetBytes || !isMaterialName(asset.preset))
    refuseAsset("preset is no name; allowed: up to ", kMostPresetBytes, " bytes without control characters");
}

void checkMaterials(const Asset& asset) {
  const std::uint32_t inner = asset.innerMaterial();
  for (const Cell& cell : asset.cells)
    for (std::uint32_t t = 0; t < cell.outerTriangles + cell.innerTriangles; ++t) {
      const std::uint32_t triangle = cell.firstTriangle + t;
      const std::uint32_t material = asset.materials[triangle];
      if (t < cell.outerTriangles && material >= inner)
        refuseAsset("materials[", triangle, "] is ", material, " on an outer face; allowed: 0 to ",
                    inner - 1);
      if (t >= cell.outerTriangles && material != inner)
        refuseAsset("materials[", triangle, "] is ", material, " on an inner face; allowed: ", inner);
    }
}

}  // namespace

void checkLook(const Asset& asset) {
  checkPreset(asset);
  checkLengthOrNone(asset.uvs.size(), asset.corners.size(), "uvs", "corner");
  checkLengthOrNone(asset.materials.size(), asset.triangles.size(), "materials", "triangle");
  for (std::size_t c = 0; c < asset.uvs.size(); ++c)
    if (!asset.uvs[c].allFinite())
      refuseAsset("uvs[", c, "] is (", asset.uvs[c].transpose(), "); allowed: finite numbers");
  checkNames(asset);
  if (!asset.materials.empty()) checkMaterials(asset);
}

}  // namespace rubble::base
