// What generated cases came to, in Rubble and in stock Bullet, as tables and as a picture.
#pragma once

#include <array>
#include <span>
#include <string>

#include "demo/heat_map.h"
#include "demo/markdown_table.h"
#include "demo/stability/runner.h"
#include "demo/stability/stock_run.h"

namespace rubble::demo {

struct StabilityResult {
  stability::Case definition;
  stability::Outcome outcome;
  stability::StockOutcome stock;
};

/// One of stable, degraded, refused, stopped, and last: broke the promise, however it ended.
inline constexpr std::size_t kStabilityKinds = 5;
std::size_t kindOf(const stability::Outcome& outcome);
const char* kindName(std::size_t kind);

/// Counts: a row for all cases and one for each of several ranges of what they are made of that holds any.
TextRows stabilityTable(std::span<const StabilityResult> results);

/// Every case with all that it is made of.
TextRows stabilityCsv(std::span<const StabilityResult> results);

/// Over stiffness and mass ratio, and over stiffness and frame step; Rubble left, stock Bullet right.
HeatMap stabilityMap(std::span<const StabilityResult> results);

}  // namespace rubble::demo
