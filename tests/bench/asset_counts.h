// What an asset's cells and springs are like, as numbers of a benchmark.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "rubble/asset.h"

namespace rubble::test {

double meanOf(const std::vector<double>& values);
double leastOf(const std::vector<double>& values);
/// Of each element to the nearest other one [m].
std::vector<double> nearestDistances(const Asset& asset);

/// Counts "surface cells" [%], "volume deviation", "volume least", "volume most", "springs", "faces" and
/// "triangles".
void countCells(const Asset& asset, benchmark::UserCounters& counters);

}  // namespace rubble::test
