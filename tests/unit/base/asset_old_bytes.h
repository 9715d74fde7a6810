// Files of versions 1 to 5 as earlier libraries wrote them, written down a second time on purpose.
#pragma once

#include <string>

#include "unit/base/asset_bytes.h"

namespace rubble::test {

/// The asset in the lowest version that holds all of it.
inline std::string oldBytesOf(const Asset& asset) {
  std::string names;
  for (const std::string& name : asset.materialNames) names.append(name).push_back('\0');
  const bool hasLook = !asset.uvs.empty() || !asset.materials.empty() || !names.empty();
  const std::uint32_t version = hasLook ? 3 : asset.rest ? 2 : 1;
  std::string bytes = "RUBBLEAS";
  const auto put = [&bytes](const auto&... values) {
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  };
  const auto putCounts = [&put](const auto&... counts) { (put(std::uint64_t(counts)), ...); };
  put(version, std::uint32_t(hasLook ? kLookHeaderBytes : kOldHeaderBytes), std::uint64_t{0}, asset.radius);
  putCounts(asset.positions.size(), asset.springs.size(), asset.anchors.size(), asset.vertices.size(),
            asset.corners.size(), asset.triangles.size(), asset.faces.size(), asset.cells.size());
  if (hasLook)
    putCounts(asset.uvs.size(), asset.materials.size(), names.size(),
              asset.rest ? asset.positions.size() : 0);
  for (const Eigen::Vector3d& p : asset.positions) put(p.x(), p.y(), p.z());
  for (const double volume : asset.volumes) put(volume);
  for (const double gyration : asset.gyrations) put(gyration);
  for (const AssetSpring& s : asset.springs) put(s.first, s.second, s.area);
  for (const AssetAnchor& a : asset.anchors) put(a.element, a.area, a.point.x(), a.point.y(), a.point.z());
  for (const CellVertex& v : asset.vertices) put(v.position.x(), v.position.y(), v.position.z(), v.elements);
  for (const CellCorner& c : asset.corners)
    put(c.vertex, c.element, c.normal.x(), c.normal.y(), c.normal.z());
  for (const auto& triangle : asset.triangles) put(triangle);
  for (const CellFace& f : asset.faces)
    put(f.neighbour, f.area, f.normal.x(), f.normal.y(), f.normal.z(), f.centroid.x(), f.centroid.y(),
        f.centroid.z());
  for (const Cell& c : asset.cells)
    put(c.firstTriangle, c.outerTriangles, c.innerTriangles, c.firstFace, c.faceCount);
  for (const Eigen::Vector2f& uv : asset.uvs) put(uv.x(), uv.y());
  for (const std::uint16_t material : asset.materials) put(material);
  bytes += names;
  if (asset.rest) {
    put(asset.rest->key);
    for (const Eigen::Vector3d& d : asset.rest->displacements) put(d.x(), d.y(), d.z());
    for (const auto& q : asset.rest->rotations) put(q.x(), q.y(), q.z(), q.w());
  }
  seal(bytes);
  return bytes;
}

/// A file of version 6 as version 5 had it: without the preset.
inline std::string bytesWithoutPreset(std::string bytes) {
  setNumber(bytes, kVersionAt, std::uint32_t(5));
  setNumber(bytes, kHeaderSizeAt, std::uint32_t(kOriginHeaderBytes));
  bytes.erase(kPresetAt, kCountsAt - kPresetAt);
  seal(bytes);
  return bytes;
}

/// The same as version 4 had it: without the origin.
inline std::string bytesWithoutOrigin(std::string bytes) {
  setNumber(bytes, kVersionAt, std::uint32_t(4));
  setNumber(bytes, kHeaderSizeAt, std::uint32_t(kLookHeaderBytes));
  bytes.erase(kOriginAt, kCountsAt - kOriginAt);
  seal(bytes);
  return bytes;
}

}  // namespace rubble::test
