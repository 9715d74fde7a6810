#include "edem/corner_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubble::edem {
namespace {

constexpr std::size_t kFewestSlots = 16;
// Of depths of one instant that are worked out twice.
constexpr double kRounding = 1e-3;

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

void CornerTable::split(std::uint32_t body, std::span<const std::uint8_t> which, std::uint32_t newBody) {
  for (CornerMemory& corner : m_all)
    if (corner.body == body && which[corner.element]) corner.body = newBody;
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
// nearer in the last step, but no deeper than it is in it and by no stiffer a spring. So does one that goes
// over to another face of its cell, deeper or less deep by more than its way.
CornerMemory& CornerMemories::press(const CornerName& name, const CornerPress& press) {
  CornerMemory* now = m_now.find(name);
  // Looked at again at one instant, it goes on from there.
  const CornerMemory* last = now ? now : m_before.find(name);
  CornerMemory next{name, press.body, press.element, 0, press.depth - press.way};
  next.stiffness = press.stiffness;
  const bool isElsewhere = last && (last->body != press.body || last->element != press.element);
  const double depthLast = last ? last->pressed + last->sunk : 0;
  const bool slides = last && (isElsewhere || std::abs(press.depth - depthLast) >
                                                  press.way + kRounding * (press.depth + depthLast));
  if (slides) {
    const double wanted = std::max(0.0, last->pressed + 0.5 * (press.nearerLast + press.nearer));
    const bool stiffer = press.stiffness > last->stiffness;
    next.sunk = press.depth - (stiffer ? wanted * std::sqrt(last->stiffness / press.stiffness) : wanted);
  } else if (last) {
    next.sunk = last->sunk;
  }
  next.sunk = std::clamp(next.sunk, 0.0, press.depth);
  next.pressed = press.depth - next.sunk;
  if (slides && !now) {
    // What leapfrog's half forces do on the way, less what the spring then holds.
    const double before = last->pressed, after = next.pressed;
    next.lost = 0.5 * (last->stiffness * before * (before + press.nearerLast) +
                       press.stiffness * after * (press.nearer - after));
  }
  if (!now) now = &m_now.add(name);
  *now = next;
  return *now;
}

double CornerMemory::lostOutside(double moved) const {
  return 0.5 * stiffness * pressed * std::max(0.0, pressed + moved * speed);
}

}  // namespace rubble::edem
