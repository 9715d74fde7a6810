// Which of many boxes overlap.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

namespace rubble::cooking {

/// Calls visit(a, b), a < b, once for each two boxes that overlap or touch, always in the same order. False:
/// given up after the time of `mostTests` comparisons of boxes, 16 for each visit: long boxes across each
/// other may all overlap.
bool visitOverlaps(const std::vector<Eigen::AlignedBox3d>& boxes, std::size_t mostTests,
                   const std::function<void(std::uint32_t, std::uint32_t)>& visit);

}  // namespace rubble::cooking
