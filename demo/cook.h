// `rubble cook`: a mesh file into an asset.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace rubble::demo {

struct CookFileOptions {
  std::filesystem::path mesh;   ///< OBJ, OFF, PLY or STL
  std::filesystem::path asset;  ///< ends in .rubble-asset
  /// Neither: 2048. The radius alone: as many as fill the solid like those whose radius is chosen.
  std::optional<std::uint64_t> elements;
  std::optional<double> radius;           ///< [m]
  std::optional<double> scale;            ///< of one unit of the mesh [m]; none: 1
  std::optional<Eigen::Vector3d> anchor;  ///< direction of the side that is tied to the world
  /// What has its centroid in one of these is tied, too; in the mesh's coordinates, scaled [m].
  std::vector<Eigen::AlignedBox3d> anchorBoxes;
  /// Name of the preset that the asset keeps; none: an object says itself what it is made of.
  std::optional<std::string> material;
  std::uint64_t seed = 1;
  bool repair = false;  ///< the mesh, before it is cooked
};

/// Writes the asset and tells in one line what was made, and on stderr in one each what was repaired and what
/// looks like a wrong unit. Throws InputError before the long work where it can, MachineError; the asset is
/// written whole or not at all.
void cookFile(const CookFileOptions& options, std::ostream& out);

}  // namespace rubble::demo
