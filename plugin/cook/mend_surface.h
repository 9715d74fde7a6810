// The third door to CGAL: holes, parts that overlap and which way is out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cook/soup.h"
#include "rubble/repair.h"

namespace rubble::cooking {

struct Hole {
  std::size_t edges = 0;
  double area = 0;  ///< of the triangles that fill it, or would; of its flat outline if none do [m^2]
};

struct NotUnited {
  std::size_t parts = 0;
  std::string why;
};

struct Mended {
  std::vector<Hole> filled, tooLarge;
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
