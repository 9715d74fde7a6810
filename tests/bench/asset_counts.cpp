#include "bench/asset_counts.h"

#include <algorithm>
#include <cmath>

namespace rubble::test {

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

double leastOf(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

std::vector<double> nearestDistances(const Asset& asset) {
  std::vector<double> nearest(asset.elementCount(), HUGE_VAL);
  for (std::size_t a = 0; a < asset.elementCount(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double distance = (asset.positions[a] - asset.positions[b]).norm();
      nearest[a] = std::min(nearest[a], distance);
      nearest[b] = std::min(nearest[b], distance);
    }
  return nearest;
}

void countCells(const Asset& asset, benchmark::UserCounters& counters) {
  const auto n = double(asset.elementCount());
  const auto outer = std::count_if(asset.cells.begin(), asset.cells.end(),
                                   [](const Cell& c) { return c.outerTriangles > 0; });
  counters["surface cells"] = 100 * double(outer) / n;
  std::vector<double> volumes, squares;
  for (const double volume : asset.volumes) volumes.push_back(volume * n / asset.volume());
  for (const double volume : volumes) squares.push_back((volume - 1) * (volume - 1));
  counters["volume deviation"] = std::sqrt(meanOf(squares));
  counters["volume least"] = leastOf(volumes);
  counters["volume most"] = *std::max_element(volumes.begin(), volumes.end());
  counters["springs"] = 2 * double(asset.springs.size()) / n;  // each at two
  counters["faces"] = double(asset.faces.size()) / n;
  counters["triangles"] = double(asset.triangles.size()) / n;
}

}  // namespace rubble::test
