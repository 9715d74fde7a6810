#include "bullet/energy_balance.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/hash.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// In words with a factor each, for there may be a thousand parts.
class SurfaceSum {
 public:
  void add(std::uint64_t word) {
    m_factor += 0x9e3779b97f4a7c15u;  // as far from all others as can be: the golden section of 2^64
    m_sum += word * (m_factor | 1);
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  // A mesh is the piece of it that is near: another piece is another surface, too.
  void add(const edem::Collider& part) {
    m_sum = (m_sum ^ m_sum >> 32) * base::Fnv1a::kPrime;
    add(std::uint64_t(part.kind));
    for (const double size : part.size) add(size);
    add(part.offset);
    add(part.rounding);
    for (const double number : part.place.matrix().topRows<3>().reshaped()) add(number);
    add(std::uint64_t(reinterpret_cast<std::uintptr_t>(part.hull.get())));
    add(std::uint64_t(reinterpret_cast<std::uintptr_t>(part.mesh.get())));
  }
  std::uint64_t value() const { return m_sum; }

 private:
  std::uint64_t m_sum = base::Fnv1a::kOffsetBasis, m_factor = 0;
};

}  // namespace

// What is not near any more may come back with another surface: a first contact at depth gives no kick.
void EnergyBalance::noteShapes(std::span<const edem::RigidProxy> proxies) {
  m_known.swap(m_shapes);
  m_shapes.clear();
  for (const edem::RigidProxy& proxy : proxies) {
    SurfaceSum sum;
    for (const edem::Collider& part : proxy.parts) sum.add(part);
    m_shapes.push_back({proxy.key, sum.value()});
  }
  std::ranges::sort(m_shapes, {}, &Surface::key);
  for (auto known = m_known.begin(); const Surface& surface : m_shapes) {
    while (known != m_known.end() && known->key < surface.key) ++known;
    if (known == m_known.end()) break;
    if (known->key == surface.key && known->sum != surface.sum) m_anew = true;
  }
}

std::optional<double> EnergyBalance::beyond(const edem::Books& books, double rigid, double rounding) {
  const double held = books.kinetic + books.elastic, initial = books.initialEnergy + m_unbooked,
               brought = initial + books.gravity.work.done();
  double put = brought + books.bullet.work.done() + books.anchors.work.done();
  if (std::exchange(m_anew, false) && held > put) {
    m_unbooked += held - put;
    put = held;
  }
  m_rounding = std::max(m_rounding, rounding);
  // A rigid body's energy is in the world before it is given.
  m_most = std::max({m_most, initial, put, brought + rigid});
  // Not against what is left of it: small errors of the books add up where things stand for hours.
  if (!(held > (1 + kTolerance) * m_most + m_rounding)) return std::nullopt;
  return held;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
