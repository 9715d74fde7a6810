// Which triangles of a soup go on across which side, and which way they turn.
#pragma once

#include <cstddef>
#include <optional>

#include "cook/soup.h"

namespace rubble::cooking {

struct Sided {
  std::size_t parted = 0;  ///< edges of four triangles and more that were parted into edges of two
};

/// Makes a soup one of surfaces without branches whose triangles turn alike: at edges of an even number of
/// triangles each two go together that have solid between them, triangles turn as most of their surface do,
/// and a vertex where surfaces only touch becomes one for each; where they touch along a single edge it is
/// cut for each. Nothing, and the soup is as it was, where an edge has three triangles, or five, or a surface
/// has one side.
std::optional<Sided> makeSided(Soup& soup);

}  // namespace rubble::cooking
