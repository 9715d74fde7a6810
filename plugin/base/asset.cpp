#include "rubble/asset.h"

#include <algorithm>
#include <cmath>

#include "base/asset_check.h"

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

void Asset::validate() const {
  base::checkCounts(*this);
  base::checkIndices(*this);
  base::checkLook(*this);
  const base::AssetScale scale = base::checkNumbers(*this);
  base::checkCells(*this, scale);
  base::checkNeighbours(*this);
  base::checkDistances(*this);
}

}  // namespace rubble
