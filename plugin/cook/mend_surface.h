// Holes, parts that overlap and which way is out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cook/fill_holes.h"
#include "cook/soup.h"
#include "rubble/repair.h"

namespace rubble::cooking {

struct NotUnited {
  std::size_t parts = 0;
  std::string why;
};

struct Mended {
  Holes holes;
  std::size_t united = 0;                ///< parts that became fewer
  std::size_t remaining = 0;             ///< what those became
  std::vector<NotUnited> notUnited;      ///< overlapping parts that stay as they are
  std::size_t crossings = 0;             ///< pairs of triangles that pass through each other and stay so
  Eigen::Vector3d crossing = {0, 0, 0};  ///< a corner of the first of them
};

/// Fills holes, unites closed parts, turns parts outwards or, within others, inwards. The soup has passed
/// makeSided. What is open in the end is not turned, and what passes through itself as a whole.
Mended mendSurface(Soup& soup, const RepairOptions& options);

}  // namespace rubble::cooking
