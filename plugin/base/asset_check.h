// The parts of Asset::validate, to be called in this order: each relies on what those before it made sure
// of. All take linear time. Each throws rubble::Error with one line: the field, its index, its value and what
// is allowed.
//
// What the numbers are measured against are the cell meshes, whose vertices are floats: at 10 km from the
// origin they are half a millimetre off. Every comparison with them allows for that rounding and no more.
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <sstream>

#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::base {

/// Where an asset lies and how sharp its cell vertices are.
struct AssetScale {
  Eigen::AlignedBox3d bounds;  ///< of the cell vertices, grown by `rounding` [m]
  double rounding;             ///< no cell vertex is farther from its place before it became float [m]
};

/// Lengths of the arrays, against one another and against what an index can name.
void checkCounts(const Asset& asset);
/// Every index, range and order. Afterwards all of them can be followed.
void checkIndices(const Asset& asset);
/// Texture coordinates and materials, with the names of these.
void checkLook(const Asset& asset);
/// Every number by itself, and sizes against the bounds.
AssetScale checkNumbers(const Asset& asset);
/// Faces between cells stand on both sides and once a side; springs join cells with a face between them.
void checkNeighbours(const Asset& asset);
/// Places, volumes, gyrations and areas against the cell they belong to.
void checkCellShapes(const Asset& asset, const AssetScale& scale);
/// No two elements in one place, or nearly so.
void checkDistances(const Asset& asset);

template <class... Parts>
[[noreturn]] void refuseAsset(const Parts&... parts) {
  std::ostringstream text;
  text << "asset: ";
  (text << ... << parts);
  throw Error(text.str());
}

/// Of a sphere [m^3].
inline double ballVolume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

}  // namespace rubble::base
