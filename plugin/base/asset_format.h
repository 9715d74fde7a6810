// The layout of the asset file. Little-endian whatever the host.
//
//   magic "RUBBLEAS" | version u32 | header size u32 | checksum u64 | radius f64 | origin 3 f64 |
//   preset 64 bytes | 12 counts u64 | the arrays
//
// The arrays are those of visitAssetArrays, in that order. Each starts at a multiple of 8 bytes, with zeros
// before it if need be, and holds its records as they stand in memory on little-endian machines: read in one
// piece, or used where the file is mapped. The preset's name is filled up with zeros. The last four counts
// are of texture coordinates, triangles with a material, bytes of the materials' names (each ends with a
// zero) and elements with a static state, all or none. The checksum covers everything behind it. The counts
// say how long the file must be.
//
// Versions 1 to 5 are read and no longer written. They have no preset, and versions 1 to 4 no origin: it is
// zero. Versions 1 to 3 have no
// gaps: not between arrays, nor in anchors. Versions 1 and 2 have the first 8 counts; version 2 has a static
// state of every element. Their checksum has one lane.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>

#include "base/material_name.h"
#include "rubble/asset.h"

namespace rubble::base {

inline constexpr std::array<char, 8> kAssetMagic = {'R', 'U', 'B', 'B', 'L', 'E', 'A', 'S'};
inline constexpr std::uint32_t kAssetVersionWithRest = 2;  // of every element
inline constexpr std::uint32_t kAssetVersion = 6;          // that is written

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

/// Bytes of one record of each array in versions 1 to 3, and what messages call it.
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
/// Of an anchor since version 4: four zeros stand behind its element.
inline constexpr std::uint64_t kAlignedAnchorBytes = 40;
/// Where arrays may start since version 4 [bytes].
inline constexpr std::uint64_t kAssetAlignment = 8;

/// Of the preset's name in the file, one zero at least behind it.
inline constexpr std::size_t kAssetPresetBytes = kMostPresetBytes + 1;

/// What the versions differ in.
struct AssetLayout {
  std::size_t counts;  ///< in the header
  bool isAligned;
  bool hasOrigin;
  bool hasPreset;

  std::size_t countsOffset() const {
    return kAssetBodyOffset + 8 + (hasOrigin ? 3 * 8 : 0) + (hasPreset ? kAssetPresetBytes : 0);
  }
  std::size_t headerBytes() const { return countsOffset() + 8 * counts; }
};
/// By version, from 1 on.
inline constexpr std::array<AssetLayout, kAssetVersion> kAssetLayouts = {{{kShapeArrays, false, false, false},
                                                                          {kShapeArrays, false, false, false},
                                                                          {kAssetArrays, false, false, false},
                                                                          {kAssetArrays, true, false, false},
                                                                          {kAssetArrays, true, true, false},
                                                                          {kAssetArrays, true, true, true}}};

/// The largest file that is written or read [bytes]: ten million elements, the most that the cook makes, take
/// about 28 GB. It also keeps every count below what a 32-bit index can name.
inline constexpr std::uint64_t kMostAssetBytes = std::uint64_t{32} << 30;
/// Files are read in blocks of so many bytes: the checksum finds them in the cache.
inline constexpr std::size_t kAssetBlock = std::size_t{1} << 17;

/// Bytes of `count` records of an array in the file, with the zeros behind them. Takes counts that fit into a
/// file.
inline std::uint64_t assetArrayBytes(AssetArray array, std::uint64_t count, bool aligned) {
  if (!aligned) return count * kAssetRecords[array].bytes;
  const std::uint64_t bytes = count * (array == kAnchors ? kAlignedAnchorBytes : kAssetRecords[array].bytes);
  return (bytes + kAssetAlignment - 1) / kAssetAlignment * kAssetAlignment;
}

/// The names of the materials as the file holds them.
inline std::string nameBytesOf(const Asset& asset) {
  std::string names;
  for (const std::string& name : asset.materialNames) names.append(name).push_back('\0');
  return names;
}

/// The arrays in the file's order, to be written or read: `visit.array(which, vector)` is called for each,
/// `visit.number(key)` for the static state's. `names` are the bytes of nameBytesOf, or room for them.
template <class AssetType, class Names, class Visit>
void visitAssetArrays(AssetType& asset, Names& names, Visit&& visit) {
  visit.array(kElements, asset.positions);
  visit.array(kElements, asset.volumes);
  visit.array(kElements, asset.gyrations);
  visit.array(kSprings, asset.springs);
  visit.array(kAnchors, asset.anchors);
  visit.array(kVertices, asset.vertices);
  visit.array(kCorners, asset.corners);
  visit.array(kTriangles, asset.triangles);
  visit.array(kFaces, asset.faces);
  visit.array(kCells, asset.cells);
  visit.array(kUvs, asset.uvs);
  visit.array(kMaterials, asset.materials);
  visit.array(kNameBytes, names);
  if (!asset.rest) return;
  visit.number(asset.rest->key);
  visit.array(kRest, asset.rest->displacements);
  visit.array(kRest, asset.rest->rotations);
}

/// Calls `field` for every number or vector of numbers of a record, in the order of the file.
template <class Record, class Field>
void visitRecord(Record& r, Field&& field) {
  using Plain = std::remove_const_t<Record>;
  if constexpr (std::is_same_v<Plain, AssetSpring>) {
    field(r.first), field(r.second), field(r.area);
  } else if constexpr (std::is_same_v<Plain, AssetAnchor>) {
    field(r.element), field(r.area), field(r.point);
  } else if constexpr (std::is_same_v<Plain, CellVertex>) {
    field(r.position), field(r.elements);
  } else if constexpr (std::is_same_v<Plain, CellCorner>) {
    field(r.vertex), field(r.element), field(r.normal);
  } else if constexpr (std::is_same_v<Plain, CellFace>) {
    field(r.neighbour), field(r.area), field(r.normal), field(r.centroid);
  } else if constexpr (std::is_same_v<Plain, Cell>) {
    field(r.firstTriangle), field(r.outerTriangles), field(r.innerTriangles), field(r.firstFace),
        field(r.faceCount);
  } else if constexpr (requires { r.coeffs().w(); }) {
    field(r.coeffs());
  } else {
    field(r);
  }
}

/// Calls `field` so for every record of all arrays.
template <class Field>
struct AssetFieldVisit {
  Field& field;

  template <class Number>
  void number(Number& value) {
    field(value);
  }
  template <class Records>
  void array(AssetArray, Records& records) {
    for (auto& record : records) visitRecord(record, field);
  }
};
template <class AssetType, class Names, class Field>
void visitAssetFields(AssetType& asset, Names& names, Field&& field) {
  visitAssetArrays(asset, names, AssetFieldVisit<std::remove_reference_t<Field>>{field});
}

/// Turns a number or vector of numbers from the host's order of bytes into the file's, or back.
template <class Value>
void turnBytes(Value& value) {
  if constexpr (std::endian::native == std::endian::little) return;
  if constexpr (std::is_arithmetic_v<Value>) {
    auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(Value)>>(value);
    std::reverse(bytes.begin(), bytes.end());
    value = std::bit_cast<Value>(bytes);
  } else {
    for (auto& number : value) turnBytes(number);
  }
}

// Records that are read and written as they stand in memory.
static_assert(sizeof(AssetSpring) == kAssetRecords[kSprings].bytes);
static_assert(sizeof(CellVertex) == kAssetRecords[kVertices].bytes);
static_assert(sizeof(CellCorner) == kAssetRecords[kCorners].bytes);
static_assert(sizeof(CellFace) == kAssetRecords[kFaces].bytes);
static_assert(sizeof(Cell) == kAssetRecords[kCells].bytes);

}  // namespace rubble::base
