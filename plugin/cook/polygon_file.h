// The second door to CGAL: the text of a mesh file in, polygons out, as the file has them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace rubble::cooking {

/// Polygons as a file has them: nothing is checked yet.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<std::uint32_t>> polygons;  ///< into points
};

/// Formats that are read here: `Obj` and `Ply` as plainObj and plainPly give them, `Stl` in its text form.
enum class PolygonFormat { Obj, Off, Ply, Stl };

/// Empty if the bytes are not of that format.
PolygonSoup parsePolygons(std::string bytes, PolygonFormat format);

}  // namespace rubble::cooking
