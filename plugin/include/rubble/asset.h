// What cooking a closed surface gives: elements, springs, anchors and cell meshes. Immutable and shared by
// any number of bodies; the state of a body is elsewhere. Plain arrays, SI units, in a frame along the mesh's
// axes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubble {

struct Material;

/// Marks "no element": outside of the solid, or an unused place in a list of fixed length.
inline constexpr std::uint32_t kNoElement = 0xffffffffu;

/// A pore spring's place: the two elements whose clipped Voronoi cells share a face.
struct AssetSpring {
  std::uint32_t first;   ///< element I, first < second
  std::uint32_t second;  ///< element K
  double area;           ///< area of the shared clipped face [m^2]
};

/// Ties an element to a fixed point (the world, or a Bullet body) by a spring over the face `area`.
struct AssetAnchor {
  std::uint32_t element;
  double area;            ///< area of the cell's outer face at the anchor [m^2]
  Eigen::Vector3d point;  ///< the tied point: centroid of that face [m]
};

/// A place where up to four cells meet. A mesh vertex touches one cell, a mesh edge cut by a bisector two, a
/// triangle cut by a Voronoi edge three, a Voronoi vertex four; unused places hold kNoElement and stand last.
struct CellVertex {
  Eigen::Vector3f position;  ///< at rest [m]
  std::array<std::uint32_t, 4> elements;
};

/// One corner of a drawn triangle: the copy of a CellVertex that belongs to one cell.
struct CellCorner {
  std::uint32_t vertex;    ///< into Asset::vertices
  std::uint32_t element;   ///< the cell this copy belongs to; one of vertices[vertex].elements
  Eigen::Vector3f normal;  ///< unit normal at rest, out of the cell; the mesh's own on outer faces
};

/// A face of a cell: one per Voronoi face inside the solid, and one per patch of the solid's surface.
struct CellFace {
  std::uint32_t neighbour;   ///< the element on the other side, or kNoElement for a patch of the surface
  float area;                ///< [m^2]
  Eigen::Vector3f normal;    ///< unit, out of the cell
  Eigen::Vector3f centroid;  ///< at rest [m]
};

/// The mesh of one element. Triangles [firstTriangle, firstTriangle + outerTriangles) lie on the solid's
/// surface, the innerTriangles behind them on faces towards other cells.
struct Cell {
  std::uint32_t firstTriangle;
  std::uint32_t outerTriangles;
  std::uint32_t innerTriangles;
  std::uint32_t firstFace;
  std::uint32_t faceCount;
};

/// The static state of an anchored body of the asset under gravity, kept so that bodies need not solve it
/// again. It is checked before it is used: one of another material or gravity, or one that leaves forces
/// unbalanced, is not taken. `rubble::prestress` (rubble/prestress.h) makes it.
struct AssetRest {
  /// Hash of what the state depends on: constants of the material, model, gravity, precision, and the asset's
  /// elements, springs and anchors. Made and compared by the solver.
  std::uint64_t key = 0;
  std::vector<Eigen::Vector3d> displacements;  ///< asset axes [m] (n x 3)
  /// Unit quaternions, asset axes (n x 4).
  std::vector<Eigen::Quaternion<double, Eigen::DontAlign>> rotations;
};

struct Asset {
  /// Where the asset's frame starts in the mesh's coordinates [m]; all other places are relative to it. Zero
  /// unless the mesh lies so far from its own origin that floats would not hold its corners there (see cook).
  /// An application that wants the solid where the mesh said moves DestructibleBodyDef::transform by it.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  // Elements: arrays of length n.
  double radius = 0;                       ///< r of every element [m]
  std::vector<Eigen::Vector3d> positions;  ///< centres at rest [m] (n x 3)
  std::vector<double> volumes;             ///< of the clipped Voronoi cells [m^3]; they add up to the solid's
  /// a third of the trace of the cell's inertia about its centroid, per kilogram [m^2].
  std::vector<double> gyrations;

  std::vector<AssetSpring> springs;  ///< sorted by (first, second)
  std::vector<AssetAnchor> anchors;  ///< sorted by element

  // Cell meshes.
  std::vector<CellVertex> vertices;
  std::vector<CellCorner> corners;
  /// Into corners; counter-clockwise seen from outside the cell.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<CellFace> faces;  ///< grouped by cell
  std::vector<Cell> cells;      ///< one an element (n)

  // What the mesh said of its look, in lists that can be used as they are; see also rubble/triangle_look.h.
  /// Texture coordinates, one a corner; none if the mesh had none. The mesh's own on outer faces, boxUv on
  /// inner ones.
  std::vector<Eigen::Vector2f> uvs;
  /// One a triangle: into materialNames on outer faces, innerMaterial() on inner ones. None where all outer
  /// faces have material 0.
  std::vector<std::uint16_t> materials;
  std::vector<std::string> materialNames;  ///< none if the mesh had none

  std::optional<AssetRest> rest;  ///< none unless it was asked for

  /// Name of the material preset that it was cooked for (`rubble cook --material`), empty if none. Bodies do
  /// not read it: DestructibleBodyDef::material says what they are made of.
  std::string preset;
  /// That preset; without a name Material's defaults. Throws rubble::Error naming the presets if this library
  /// knows none of that name.
  Material material() const;

  std::size_t elementCount() const { return positions.size(); }
  double volume() const;  ///< of the solid [m^3]
  /// Mean element spacing h = (V / n)^(1/3) [m]; the h of the material's contact stiffness k_c = factor E h.
  double spacing() const;
  Eigen::AlignedBox3d bounds() const;  ///< of the cell vertices [m]
  double diagonal() const;             ///< of the bounds [m]

  /// The material of inner faces, behind those of the mesh, which has one at least, if without a name.
  std::uint32_t innerMaterial() const;

  /// Faces of one cell.
  std::span<const CellFace> cellFaces(std::size_t element) const;

  /// Throws rubble::Error with one line, the field, its index, its value and what is allowed, when a count,
  /// an index or a number is impossible: places beyond 1e9 m, or so far out that floats do not hold the
  /// vertices (see cook), solids over 1e6 m across, radii below 1e-6 m,
  /// elements nearer than half a radius to one another, or volumes, gyrations, areas and places that
  /// contradict the cell's triangles, texture coordinates or materials that are none, or a static state that
  /// is not one an element, moves an element farther than the solid is large, or turns it by no rotation.
  /// `load` has called it already. Linear time.
  void validate() const;
};

/// Writes a versioned little-endian file, version 6, with sizes and a checksum. Its arrays start at multiples
/// of 8 bytes and are as in memory, so that it can be used where it is mapped (base/asset_format.h). The file
/// appears whole or not at all, and nothing stays beside it.
/// Throws rubble::Error naming the file and the reason: an asset that is not valid or would take more than 32
/// GiB, a folder or device of that name, no permission, a full disk.
void save(const Asset& asset, const std::filesystem::path& file);
/// Reads such a file, or one of versions 1 to 5, and trusts nothing in it: header and length are checked
/// before the asset gets any memory, then the checksum, and the asset is validated. Throws rubble::Error
/// naming the file and what is wrong with it.
Asset load(const std::filesystem::path& file);

}  // namespace rubble
