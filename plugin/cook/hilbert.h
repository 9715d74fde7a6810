// Order along a Hilbert curve: neighbours in the order are neighbours in space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace rubble::cooking {

/// Indices of the places in the order in which a Hilbert curve through the cube around them meets them.
std::vector<std::uint32_t> hilbertOrder(const std::vector<Eigen::Vector3d>& places);

}  // namespace rubble::cooking
