// What corners of a rigid body remember of the elements that they are in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edem/face_touch.h"

namespace rubble::edem {

struct CornerMemory {
  CornerName name;
  std::uint32_t body, element;  ///< id of the body
  double pressed;               ///< depth with force [m]
  double sunk;                  ///< depth without: it was first seen as deep, or gave way by it [m]
  double yielded = 0;           ///< given way by in the last step [m]
  double stiffness = 0;         ///< [N/m]
  double speed = 0;             ///< at which it nears the element [m/s]
  double lost = 0;              ///< by its spring where it came from another cell into this one [J]

  /// What its spring loses that presses nothing any more after a step of `moved` [s]: what it held and what
  /// it did on its way, if it has not left by itself [J].
  double lostOutside(double moved) const;
};

/// How a corner is in an element.
struct CornerPress {
  std::uint32_t body, element;  ///< id of the body
  double depth;                 ///< [m]
  double way;                   ///< it has come less far in the last step [m]
  double nearer;                ///< and nearer by this; less than 0: farther [m]
  double nearerLast;            ///< the same of the element that it was in at the last instant [m]
  double stiffness;             ///< [N/m]
};

/// Memories by their names.
class CornerTable {
 public:
  void clear();
  void erase(std::uint32_t body);
  void split(std::uint32_t body, std::span<const std::uint8_t> which, std::uint32_t newBody);
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
  /// A corner is in an element. Valid until the next call.
  CornerMemory& press(const CornerName& name, const CornerPress& press);
  /// Those of the last instant that are in no element at this one.
  template <class Visit>
  void visitGone(Visit&& visit) {
    for (const CornerMemory& last : m_before.all())
      if (!m_now.find(last.name)) visit(last);
  }
  /// What they remember of a body.
  void forget(std::uint32_t body);
  /// Elements marked in `which` of a body are another's now.
  void split(std::uint32_t body, std::span<const std::uint8_t> which, std::uint32_t newBody) {
    m_now.split(body, which, newBody);
    m_before.split(body, which, newBody);
  }
  /// Whether it was in that element at the last instant.
  bool wasIn(const CornerName& name, std::uint32_t body, std::uint32_t element) {
    const CornerMemory* last = m_before.find(name);
    return last && last->body == body && last->element == element;
  }
  /// At the last instant; null where it was in none.
  const CornerMemory* lastOf(const CornerName& name) { return m_before.find(name); }
  /// At this instant.
  const std::vector<CornerMemory>& all() const { return m_now.all(); }

 private:
  CornerTable m_now, m_before;
};

}  // namespace rubble::edem
