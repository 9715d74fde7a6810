// The surface of all that lies within any of some closed surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cook/crossings.h"
#include "cook/soup.h"

namespace rubble::cooking {

struct United {
  std::vector<bool>
      isKept;         ///< a shell that none overlaps and that shares no piece of face: it stays as it is
  Soup soup;          ///< the union of all others, without branches; its sources are those of the soup given
  double volume = 0;  ///< of the union before corners were joined where rounding made them one [m^3]
  std::string refusal;  ///< why there is none; empty if there is
};

/// Unites shells, closed surfaces of a soup: outwards those of solids, inwards those of cavities. shells[t]
/// is the shell of triangle t, all from 0; crossings are all there are. All is exact until corners are
/// rounded to doubles in the end, so parts may touch, share faces or lie on each other in any way. Where lone
/// shells are not to be kept they are cut where others touch them.
United uniteShells(const Soup& soup, const std::vector<std::uint32_t>& shells,
                   const std::vector<Crossing>& crossings, bool keepsLone);

}  // namespace rubble::cooking
