#include "edem/corner_memory.h"

#include <algorithm>
#include <utility>

namespace rubble::edem {
namespace {

constexpr std::size_t kFewestSlots = 16;

std::size_t hashOf(const CornerName& name) {
  std::uint64_t hash = name.part;
  for (const std::uint32_t word : {name.edge, name.corner})
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;  // Fibonacci hashing
  return std::size_t(hash >> 32);
}

}  // namespace

void CornerTable::clear() {
  if (m_all.empty()) return;
  m_all.clear();
  std::fill(m_slots.begin(), m_slots.end(), 0);
}

std::size_t CornerTable::slotOf(const CornerName& name) const {
  std::size_t slot = hashOf(name) & (m_slots.size() - 1);
  while (m_slots[slot] != 0 && !(m_all[m_slots[slot] - 1].name == name))
    slot = (slot + 1) & (m_slots.size() - 1);
  return slot;
}

CornerMemory* CornerTable::find(const CornerName& name) {
  if (m_all.empty()) return nullptr;
  const std::uint32_t place = m_slots[slotOf(name)];
  return place == 0 ? nullptr : &m_all[place - 1];
}

CornerMemory& CornerTable::add(const CornerName& name) {
  if (2 * (m_all.size() + 1) > m_slots.size()) {
    m_slots.resize(std::max(kFewestSlots, 2 * m_slots.size()));
    index();
  }
  m_slots[slotOf(name)] = std::uint32_t(m_all.size() + 1);
  return m_all.emplace_back(CornerMemory{name, 0, 0, 0, 0});
}

void CornerTable::erase(std::uint32_t body) {
  if (std::erase_if(m_all, [body](const CornerMemory& m) { return m.body == body; }) > 0) index();
}

void CornerTable::index() {
  std::fill(m_slots.begin(), m_slots.end(), 0);
  for (std::size_t i = 0; i < m_all.size(); ++i) m_slots[slotOf(m_all[i].name)] = std::uint32_t(i + 1);
}

void CornerMemories::beginStep() {
  std::swap(m_before, m_now);
  m_now.clear();
}

void CornerMemories::forget(std::uint32_t body) {
  m_now.erase(body);
  m_before.erase(body);
}

// A corner that slides from one cell into the next presses it as deep as it did, and by how much it has come
// nearer in the last step.
CornerMemory& CornerMemories::press(const CornerName& name, std::uint32_t body, std::uint32_t element,
                                    double depth, double way, double nearer) {
  CornerMemory* now = m_now.find(name);
  double sunk = depth - way;
  const auto after = [&](const CornerMemory& last) {
    return last.body == body && last.element == element ? last.sunk : depth - last.pressed - nearer;
  };
  // Looked at again at one instant, it goes on from there.
  if (now) {
    sunk = after(*now);
  } else if (const CornerMemory* last = m_before.find(name)) {
    sunk = after(*last);
  }
  sunk = std::clamp(sunk, 0.0, depth);
  if (!now) now = &m_now.add(name);
  *now = {name, body, element, depth - sunk, sunk};
  return *now;
}

}  // namespace rubble::edem
