// The layout of the asset file. Little-endian whatever the host; every record is written field by field, so
// padding never shows.
//
//   magic "RUBBLEAS" | version u32 | header size u32 | checksum u64 | radius f64 | 8 counts u64 | the arrays,
//   in that order | in version 2 the static state: key u64, displacements 3 f64, rotations x y z w f64
//
// Version 3 has 12 counts. The last four are of texture coordinates, triangles with a material, bytes of the
// materials' names (each ends with a zero) and elements with a static state, all or none; their arrays follow
// in that order. A version is written only where the one before would not do, so that older libraries read
// what they can. The checksum covers everything behind it. The counts say how long the file must be.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "rubble/asset.h"

namespace rubble::base {

inline constexpr std::array<char, 8> kAssetMagic = {'R', 'U', 'B', 'B', 'L', 'E', 'A', 'S'};
inline constexpr std::uint32_t kAssetVersion = 1;
inline constexpr std::uint32_t kAssetVersionWithRest = 2;
inline constexpr std::uint32_t kAssetVersionWithLook = 3;

enum AssetArray {
  kElements,
  kSprings,
  kAnchors,
  kVertices,
  kCorners,
  kTriangles,
  kFaces,
  kCells,
  kShapeArrays,  // all that versions 1 and 2 count
  kUvs = kShapeArrays,
  kMaterials,
  kNameBytes,
  kRest,  // its key stands in front of the first
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
                                                                         {5 * 4, "cells"},
                                                                         {2 * 4, "texture coordinates"},
                                                                         {2, "materials"},
                                                                         {1, "bytes of names"},
                                                                         {3 * 8 + 4 * 8, "static states"}}};

/// Of the static state, beside a record an element.
inline constexpr std::uint64_t kAssetRestKeyBytes = 8;

inline constexpr std::size_t kAssetChecksumOffset = kAssetMagic.size() + 4 + 4;
/// The checksum covers the file from here on.
inline constexpr std::size_t kAssetBodyOffset = kAssetChecksumOffset + 8;
/// Of versions 1 and 2, and of version 3.
inline constexpr std::size_t kAssetHeaderBytes = kAssetBodyOffset + 8 + 8 * kShapeArrays;
inline constexpr std::size_t kAssetLookHeaderBytes = kAssetBodyOffset + 8 + 8 * kAssetArrays;

/// The largest file that is written or read [bytes]: ten million elements, the most that the cook makes, take
/// about 28 GB. It also keeps every count below what a 32-bit index can name.
inline constexpr std::uint64_t kMostAssetBytes = std::uint64_t{32} << 30;
/// Files are read and written in blocks of so many bytes, a multiple of the checksum's words.
inline constexpr std::size_t kAssetBlock = std::size_t{1} << 16;
static_assert(kAssetBlock % 8 == 0);

/// The names of the materials as the file holds them.
inline std::string nameBytesOf(const Asset& asset) {
  std::string names;
  for (const std::string& name : asset.materialNames) names.append(name).push_back('\0');
  return names;
}

/// One description of the arrays' fields serves both directions: `field` writes or reads what it is given.
/// `names` are the bytes of nameBytesOf, or room for them.
template <class AssetType, class Names, class Field>
void visitAssetFields(AssetType& asset, Names& names, Field&& field) {
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
  for (auto& uv : asset.uvs) field(uv);
  for (auto& material : asset.materials) field(material);
  for (auto& letter : names) field(letter);
  if (!asset.rest) return;
  field(asset.rest->key);
  for (auto& displacement : asset.rest->displacements) field(displacement);
  for (auto& rotation : asset.rest->rotations)
    for (int part = 0; part < 4; ++part) field(rotation.coeffs()[part]);
}

}  // namespace rubble::base
