// Numbers by keys, for lookups alone: emptied at once and filled anew for every triangle or cell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cook/random.h"

namespace rubble::cooking {

/// Open addressing in one array that stays small where few keys are held at a time: it then lies in the
/// processor's cache, which a map of the whole surface does not.
template <std::size_t N>
class ScratchMap {
 public:
  using Key = std::array<std::uint32_t, N>;
  struct Found {
    std::uint32_t& number;  ///< until the next call; 0 where the key is new
    bool isNew;
  };

  ScratchMap() : m_slots(kLeastSlots) {}

  void clear() {
    m_count = 0;
    if (++m_round != 0) return;
    m_slots.assign(m_slots.size(), Slot{});
    m_round = 1;
  }

  Found find(const Key& key) {
    Slot* slot = &slotOf(key);
    if (slot->round == m_round) return {slot->number, false};
    if (2 * ++m_count > m_slots.size()) {
      grow();
      slot = &slotOf(key);
    }
    *slot = {key, 0, m_round};
    return {slot->number, true};
  }

 private:
  static constexpr std::size_t kLeastSlots = 64;  // a power of two, as all sizes are

  struct Slot {
    Key key{};
    std::uint32_t number = 0;
    std::uint32_t round = 0;  // empty unless it is the map's
  };

  static std::size_t hash(const Key& key) {
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < N; k += 2)
      sum = mix(sum + (key[k] | (std::uint64_t{k + 1 < N ? key[k + 1] : 0} << 32)));
    return sum;
  }

  // The key's own or the empty one where it belongs.
  Slot& slotOf(const Key& key) {
    const std::size_t last = m_slots.size() - 1;
    std::size_t at = hash(key) & last;
    while (m_slots[at].round == m_round && m_slots[at].key != key) at = (at + 1) & last;
    return m_slots[at];
  }

  void grow() {
    std::vector<Slot> old(2 * m_slots.size());
    std::swap(old, m_slots);
    for (const Slot& slot : old)
      if (slot.round == m_round) slotOf(slot.key) = slot;
  }

  std::vector<Slot> m_slots;
  std::uint32_t m_round = 1;
  std::size_t m_count = 0;
};

}  // namespace rubble::cooking
