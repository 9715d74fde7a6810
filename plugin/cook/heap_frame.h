// Where corners of a heap go so that what was meant to lie in a plane does.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cook/soup.h"

namespace rubble::cooking {

/// Coordinates along three directions of a heap: the axes, or the normals that most of its faces have.
/// Coordinates that differ by roundings are one.
struct HeapFrame {
  std::vector<Eigen::Vector3d> places;  ///< of the vertices, along the directions
  Eigen::Matrix3d normals;              ///< the directions, as rows; their determinant is above 0
  bool isTurned = false;                ///< the directions are not the axes
};

HeapFrame frameOf(const Soup& soup);

/// Moves places to a grid of `share` of the largest coordinate; stays where that is 0.
void moveToGrid(std::vector<Eigen::Vector3d>& places, double share);

/// Takes places back to the axes: those of vertices to just where these were.
std::vector<Eigen::Vector3d> placesBack(const HeapFrame& frame, const Soup& soup,
                                        std::vector<Eigen::Vector3d> places);

}  // namespace rubble::cooking
