// Which way is out of closed surfaces within others.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "cook/shells.h"

namespace rubble::cooking {

/// Turns shells outwards that lie within none or an even number of others, and the rest inwards: they are
/// cavities. Shells of the same heap, of triangles heaps[t], keep which way they turn to each other;
/// kNoElement is no heap. Shells do not cross.
void turnOutwards(Soup& soup, const std::vector<std::uint32_t>& heaps);

/// A shell that faces outwards within a solid, or inwards where there is none.
struct WrongShell {
  std::uint32_t shell;   ///< in the order of findShells
  std::uint32_t around;  ///< the smallest that it lies within; kNoElement: none
  bool isInward;
  Eigen::Vector3d place;  ///< of a corner [m]
};

/// The first of shells that do not cross.
std::optional<WrongShell> findWrongShell(const Soup& soup);

}  // namespace rubble::cooking
