#include "edem/corner_memory.h"

#include <algorithm>
#include <utility>

namespace rubble::edem {

void CornerMemories::beginStep() {
  std::swap(m_before, m_now);
  m_now.clear();
}

// A corner that slides from one cell into the next presses it as deep as it did, and by how much it has come
// nearer in the last step.
CornerMemory& CornerMemories::press(const CornerName& name, std::uint32_t body, std::uint32_t element,
                                    double depth, double way, double nearer) {
  const auto named = [&](const CornerMemory& m) { return m.name == name; };
  auto now = std::find_if(m_now.begin(), m_now.end(), named);
  double sunk = depth - way;
  const auto after = [&](const CornerMemory& last) {
    return last.body == body && last.element == element ? last.sunk : depth - last.pressed - nearer;
  };
  // Looked at again at one instant, it goes on from there.
  if (now != m_now.end()) {
    sunk = after(*now);
  } else if (const auto last = std::find_if(m_before.begin(), m_before.end(), named);
             last != m_before.end()) {
    sunk = after(*last);
  }
  sunk = std::clamp(sunk, 0.0, depth);
  if (now == m_now.end()) now = m_now.insert(m_now.end(), CornerMemory{});
  *now = {name, body, element, depth - sunk, sunk};
  return *now;
}

}  // namespace rubble::edem
