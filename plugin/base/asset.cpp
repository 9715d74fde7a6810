#include "rubble/asset.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/asset_check.h"
#include "rubble/material.h"

namespace rubble {

double Asset::volume() const {
  double sum = 0;
  for (const double volume : volumes) sum += volume;
  return sum;
}

double Asset::spacing() const {
  return volumes.empty() ? 0.0 : std::cbrt(volume() / double(volumes.size()));
}

Eigen::AlignedBox3d Asset::bounds() const {
  Eigen::AlignedBox3d box;
  for (const CellVertex& vertex : vertices) box.extend(vertex.position.cast<double>());
  return box;
}

double Asset::diagonal() const {
  const Eigen::AlignedBox3d box = bounds();
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::uint32_t Asset::innerMaterial() const {
  return std::uint32_t(std::max<std::size_t>(materialNames.size(), 1));
}

std::span<const CellFace> Asset::cellFaces(std::size_t element) const {
  const Cell& cell = cells[element];
  return std::span(faces).subspan(cell.firstFace, cell.faceCount);
}

Material Asset::material() const {
  return preset.empty() ? Material() : rubble::material(preset);
}

void Asset::validate() const {
  // Fewer elements take less than a few threads to wake; more threads wait for the memory.
  constexpr std::size_t kElementsAThread = 10'000;
  constexpr std::size_t kMostThreads = 4;
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  base::checkAsset(*this, int(std::clamp(elementCount() / kElementsAThread, std::size_t{1},
                                         std::min(cores, kMostThreads))));
}

}  // namespace rubble
