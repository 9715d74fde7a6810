// The layout of the asset file. Little-endian whatever the host; every record is written field by field, so
// padding never shows.
//
//   magic "RUBBLEAS" | version u32 | header size u32 | checksum u64 | radius f64 | 8 counts u64 | the arrays,
//   in that order | in version 2 the static state: key u64, displacements 3 f64, rotations x y z w f64
//
// Version 1 has no static state and is written where there is none, so that older libraries read it.
// The checksum covers everything behind it. The counts say how long the file must be.
#pragma once

#include <array>
#include <cstdint>

#include "rubble/asset.h"

namespace rubble::base {

inline constexpr std::array<char, 8> kAssetMagic = {'R', 'U', 'B', 'B', 'L', 'E', 'A', 'S'};
inline constexpr std::uint32_t kAssetVersion = 1;
inline constexpr std::uint32_t kAssetVersionWithRest = 2;

enum AssetArray {
  kElements,
  kSprings,
  kAnchors,
  kVertices,
  kCorners,
  kTriangles,
  kFaces,
  kCells,
  kAssetArrays
};
using AssetCounts = std::array<std::uint64_t, kAssetArrays>;

/// Bytes of one record of each array in the file, and what messages call it.
struct AssetRecord {
  std::uint64_t bytes;
  const char* name;
};
inline constexpr std::array<AssetRecord, kAssetArrays> kAssetRecords = {{{3 * 8 + 8 + 8, "elements"},
                                                                         {4 + 4 + 8, "springs"},
                                                                         {4 + 8 + 3 * 8, "anchors"},
                                                                         {3 * 4 + 4 * 4, "cell vertices"},
                                                                         {4 + 4 + 3 * 4, "corners"},
                                                                         {3 * 4, "triangles"},
                                                                         {4 + 4 + 3 * 4 + 3 * 4, "faces"},
                                                                         {5 * 4, "cells"}}};

/// Bytes of the static state of so many elements.
inline constexpr std::uint64_t kAssetRestBytes = 3 * 8 + 4 * 8, kAssetRestKeyBytes = 8;

inline constexpr std::size_t kAssetChecksumOffset = kAssetMagic.size() + 4 + 4;
/// The checksum covers the file from here on.
inline constexpr std::size_t kAssetBodyOffset = kAssetChecksumOffset + 8;
inline constexpr std::size_t kAssetHeaderBytes = kAssetBodyOffset + 8 + 8 * kAssetArrays;

/// The largest file that is written or read [bytes]: ten million elements, the most that the cook makes, take
/// about 28 GB. It also keeps every count below what a 32-bit index can name.
inline constexpr std::uint64_t kMostAssetBytes = std::uint64_t{32} << 30;
/// Files are read and written in blocks of so many bytes, a multiple of the checksum's words.
inline constexpr std::size_t kAssetBlock = std::size_t{1} << 16;
static_assert(kAssetBlock % 8 == 0);

/// One description of the arrays' fields serves both directions: `field` writes or reads what it is given.
template <class AssetType, class Field>
void visitAssetFields(AssetType& asset, Field&& field) {
  for (auto& position : asset.positions) field(position);
  for (auto& volume : asset.volumes) field(volume);
  for (auto& gyration : asset.gyrations) field(gyration);
  for (auto& s : asset.springs) field(s.first), field(s.second), field(s.area);
  for (auto& a : asset.anchors) field(a.element), field(a.area), field(a.point);
  for (auto& v : asset.vertices) field(v.position), field(v.elements);
  for (auto& c : asset.corners) field(c.vertex), field(c.element), field(c.normal);
  for (auto& triangle : asset.triangles) field(triangle);
  for (auto& f : asset.faces) field(f.neighbour), field(f.area), field(f.normal), field(f.centroid);
  for (auto& c : asset.cells)
    field(c.firstTriangle), field(c.outerTriangles), field(c.innerTriangles), field(c.firstFace),
        field(c.faceCount);
  if (!asset.rest) return;
  field(asset.rest->key);
  for (auto& displacement : asset.rest->displacements) field(displacement);
  for (auto& rotation : asset.rest->rotations)
    for (int part = 0; part < 4; ++part) field(rotation.coeffs()[part]);
}

}  // namespace rubble::base
