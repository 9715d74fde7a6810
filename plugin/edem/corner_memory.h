// What corners of a rigid body remember of the elements that they are in.
#pragma once

#include <cstdint>
#include <vector>

#include "edem/face_touch.h"

namespace rubble::edem {

struct CornerMemory {
  CornerName name;
  std::uint32_t body, element;  ///< id of the body
  double pressed;               ///< depth with force [m]
  double sunk;                  ///< depth without: it was first seen as deep, or gave way by it [m]
};

class CornerMemories {
 public:
  /// Those of this instant become those of the last.
  void beginStep();
  /// A corner is in an element of the body with the id `body` by `depth`, and has come nearer by `nearer` in
  /// the last step; one that was in none has come less than `way` [m]. Valid until the next call.
  CornerMemory& press(const CornerName& name, std::uint32_t body, std::uint32_t element, double depth,
                      double way, double nearer);
  /// At this instant.
  const std::vector<CornerMemory>& all() const { return m_now; }

 private:
  std::vector<CornerMemory> m_now, m_before;
};

}  // namespace rubble::edem
