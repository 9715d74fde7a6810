// The second door to CGAL: the text of a mesh file in, polygons out, as the file has them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace rubble::cooking {

inline constexpr std::uint32_t kNoLook = 0xffffffffu;

/// What a file says of a corner of a polygon beside its place; kNoLook where it says nothing.
struct CornerLook {
  std::uint32_t uv = kNoLook;      ///< into PolygonSoup::uvs
  std::uint32_t normal = kNoLook;  ///< into PolygonSoup::normals
};

/// Polygons as a file has them: nothing is checked yet.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<std::uint32_t>> polygons;  ///< into points

  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;
  /// None, or a list a polygon, which has an entry a corner or none.
  std::vector<std::vector<CornerLook>> looks;
  std::vector<std::uint16_t> materials;  ///< none, or one a polygon: into materialNames
  std::vector<std::string> materialNames;
};

/// Formats that are read here: `Stl` in its text form.
enum class PolygonFormat { Off, Stl };

/// Empty if the bytes are not of that format. Throws rubble::Error that names the line where that is for a
/// coordinate that is not finite.
PolygonSoup parsePolygons(std::string bytes, PolygonFormat format);

}  // namespace rubble::cooking
