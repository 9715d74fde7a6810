// Closed triangle mesh -> Asset: packing, Delaunay, clipped Voronoi cells, springs. Needs rubble::cook (CGAL,
// GPL); an application that loads cooked assets does not.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble {

/// A closed, outward-oriented triangle mesh.
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> vertices;                ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside

  // What it looks like. Each list has an entry a triangle, its corners in the triangle's order, or none.
  /// Normals of any length [any unit]; zero where there is none and the cook makes one.
  std::vector<std::array<Eigen::Vector3f, 3>> normals = {};
  std::vector<std::array<Eigen::Vector2f, 3>> uvs = {};  ///< texture coordinates, finite
  std::vector<std::uint16_t> materials = {};             ///< into materialNames
  /// Up to 65534 names of up to 255 bytes without control characters.
  std::vector<std::string> materialNames = {};
};

/// A box with the given full edge lengths [m] about `centre`; 8 vertices, 12 triangles.
SurfaceMesh boxMesh(const Eigen::Vector3d& size, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

/// Reads the surface in a file of the format that its ending names: .obj, .off, .ply or .stl, as text or, but
/// for OBJ, binary. `scale` is the length of one unit of the file [m], finite and above 0. Polygons are cut
/// into triangles. Vertices at exactly the same place become one where the file's own indices leave edges
/// open, as in every STL and at the seams of textures; nothing else is mended. Of OBJ normals, texture
/// coordinates (0, 0 where a face of a file that has some gives none) and the names behind `usemtl` are read,
/// not what the material files say of them; of PLY normals and texture coordinates; other formats give the
/// shape alone. Throws rubble::Error that names the file and what is wrong with it; whether the surface is
/// closed is for `cook` to say.
SurfaceMesh readMesh(const std::filesystem::path& file, double scale = 1);

struct CookOptions {
  /// Number of elements wanted (1 to 10,000,000). The cook makes exactly as many, or throws saying what fits.
  /// 0, where `radius` is given: chosen so that they fill `fill` of the solid, or fewer, with a warning,
  /// where so many do not fit.
  std::size_t elements = 2048;
  /// Radius of the elements [m]. 0: chosen so that the spheres fill `fill` of the solid, or less, with a
  /// warning, where so many of that size do not fit (thin walls, few elements).
  double radius = 0;
  /// Share of the solid that the spheres fill when `radius` is 0 (0.3 to 0.6; the paper's wall has 0.53).
  double fill = 0.48;
  /// Seed of the random start and of the Voronoi sites' jitter. The same seed gives the same bytes.
  std::uint64_t seed = 1;
  /// Relaxation ends when the deepest overlap is below this share of the diameter 2 r, or after
  /// maxIterations.
  double maxOverlap = 0.01;
  int maxIterations = 400;
  /// A spring needs a shared face of at least this share of h^2, h the mean spacing. Smaller faces are
  /// slivers.
  double minFaceArea = 0.02;
  /// Surface whose outward normal points along this direction (within 10 degrees) and which lies within
  /// anchorBand of the solid's furthest point in it is tied to the world. Unset: no anchors.
  std::optional<Eigen::Vector3d> anchorDirection;
  double anchorBand = 1e-6;  ///< [m]
  /// Boxes in the mesh's coordinates [m]: every flat side of a cell's outer surface whose centroid lies in
  /// one of them is tied likewise, whichever way it faces. Beside anchorDirection, what either finds is tied,
  /// once. A box that finds nothing is refused; Asset::anchors tells how many were found.
  std::vector<Eigen::AlignedBox3d> anchorRegions = {};
};

/// Cooks a mesh. The outer faces of the cells keep its normals, texture coordinates and materials; where it
/// has no normals, they are smooth over edges of less than 30 degrees. Parts much thinner than the rest get
/// elements too, at about equal distances: no cell reaches farther from its element than 3 mean spacings
/// (about 6 radii at the default fill), or a warning says how far. Where elements are thicker than a wall the
/// radius chosen shrinks, to half at most for the sake of a few; a warning says which radius or how many
/// elements would do for what protrudes after that. Where the solid lies farther from the mesh's origin than
/// it is large, and so far that floats would miss its corners by more than 5e-5 of the elements' spacing (a
/// metre cut into 2048 elements beyond 33 m), it is moved to its own middle first: see Asset::origin. Throws
/// rubble::Error for meshes that are not closed, not oriented, empty, not finite or that pass through
/// themselves, and when the elements wanted do not fit. What `progress` throws ends the cook and reaches the
/// caller.
Asset cook(const SurfaceMesh& mesh, const CookOptions& options, const ProgressFunction& progress = {},
           const LogFunction& log = {});

}  // namespace rubble
