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
  double yielded = 0;           ///< given way by in the last step [m]
};

/// Memories by their names.
class CornerTable {
 public:
  void clear();
  void erase(std::uint32_t body);
  /// Null where there is none of that name.
  CornerMemory* find(const CornerName& name);
  /// Of a name that is not there yet. Valid until the next call.
  CornerMemory& add(const CornerName& name);
  const std::vector<CornerMemory>& all() const { return m_all; }

 private:
  std::size_t slotOf(const CornerName& name) const;  // its own, or the empty one that it would get
  void index();

  std::vector<CornerMemory> m_all;
  std::vector<std::uint32_t> m_slots;  // place in m_all + 1, 0: empty; a power of two, half full at most
};

class CornerMemories {
 public:
  /// Those of this instant become those of the last.
  void beginStep();
  /// A corner is in an element of the body with the id `body` by `depth`, and has come nearer by `nearer` in
  /// the last step; one that was in none has come less than `way` [m]. Valid until the next call.
  CornerMemory& press(const CornerName& name, std::uint32_t body, std::uint32_t element, double depth,
                      double way, double nearer);
  /// What they remember of a body.
  void forget(std::uint32_t body);
  /// Whether it was in that element at the last instant.
  bool wasIn(const CornerName& name, std::uint32_t body, std::uint32_t element) {
    const CornerMemory* last = m_before.find(name);
    return last && last->body == body && last->element == element;
  }
  /// At this instant.
  const std::vector<CornerMemory>& all() const { return m_now.all(); }

 private:
  CornerTable m_now, m_before;
};

}  // namespace rubble::edem
