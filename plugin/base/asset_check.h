// The parts of Asset::validate, to be called in this order: each relies on what those before it made sure
// of. All take linear time. Each throws rubble::Error with one line: the field, its index, its value and what
// is allowed.
//
// What the numbers are measured against are the cell meshes, whose vertices are floats: at 10 km from the
// frame's origin they are half a millimetre off. Every comparison with them allows for that rounding and no
// more.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::base {

class CellWalk;

/// Where an asset lies and how sharp its cell vertices are.
struct AssetScale {
  Eigen::AlignedBox3d bounds;  ///< of the cell vertices, grown by `rounding` [m]
  double rounding;             ///< no cell vertex is farther from its place before it became float [m]
};

/// Of the mean spacing of the elements: no vertex may be farther from its place before it became float.
/// Planes through such vertices are then within twice that, by which edem/cell_faces.cpp tells flat from
/// bent.
inline constexpr double kSharpness = 5e-5;

/// No place is farther from where it was before it became float, with coordinates up to `farthest` [m]. Each
/// is rounded by 2^-24 of itself at most, so a place moves by sqrt(3) 2^-24 of the farthest.
inline double floatRounding(double farthest) {
  return double(std::numeric_limits<float>::epsilon()) * farthest;
}
/// The largest coordinate of a box [m].
inline double farthestOf(const Eigen::AlignedBox3d& bounds) {
  return std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
}
/// True where floats hold a solid of these bounds, of elements with that mean spacing [m]: to kSharpness, or
/// hardly worse than they would about its own middle. `slack` is a factor on both.
inline bool isSharp(const Eigen::AlignedBox3d& bounds, double spacing, double slack) {
  const double farthest = farthestOf(bounds);
  return floatRounding(farthest) <= slack * kSharpness * spacing ||
         farthest <= slack * bounds.diagonal().norm();
}

/// Asset::validate on that many threads. What it says does not depend on their number.
void checkAsset(const Asset& asset, int threads);

/// Lengths of the arrays, against one another and against what an index can name.
void checkCounts(const Asset& asset);
/// Every index, range and order but those of corners, triangles and faces.
void checkIndices(const Asset& asset);
/// Texture coordinates and materials, with the names of these.
void checkLook(const Asset& asset);
/// Every number by itself but those of corners and faces, and sizes against the bounds.
AssetScale checkNumbers(const Asset& asset);
/// Corners, triangles and faces; places, volumes, gyrations and areas against the cell they belong to.
/// Afterwards all indices can be followed.
void checkCells(const Asset& asset, const AssetScale& scale);
/// The same of cells [first, end), by a walk that stands before the first; without its end.
void checkCells(const Asset& asset, CellWalk& walk, std::uint32_t first, std::uint32_t end);
/// Faces between cells stand on both sides and once a side; springs join cells with a face between them.
void checkNeighbours(const Asset& asset);
/// No two elements in one place, or nearly so.
void checkDistances(const Asset& asset);

template <class... Parts>
[[noreturn]] void refuseAsset(const Parts&... parts) {
  std::ostringstream text;
  text << "asset: ";
  (text << ... << parts);
  throw Error(text.str());
}

/// Coordinates: beyond this squares and volumes of doubles are not sure to keep any digit [m].
inline constexpr double kLargestCoordinate = 1e9;

template <class Vector>
void checkPlace(const Vector& place, const char* array, std::size_t at, const char* field) {
  for (int axis = 0; axis < 3; ++axis) {
    const double value = double(place[axis]);
    if (!(std::abs(value) <= kLargestCoordinate))
      refuseAsset(array, '[', at, ']', field, '.', "xyz"[axis], " is ", value, " m; allowed: -",
                  kLargestCoordinate, " to ", kLargestCoordinate);
  }
}

inline void checkArea(double area, const char* array, std::size_t at, double least) {
  if (!(area >= least) || !std::isfinite(area))
    refuseAsset(array, '[', at, "].area is ", area, " m^2; allowed: finite and at least ", least);
}

/// Of a sphere [m^3].
inline double ballVolume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

}  // namespace rubble::base
