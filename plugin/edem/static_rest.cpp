#include "edem/static_rest.h"

#include <array>
#include <bit>
#include <utility>

#include "base/hash.h"

namespace rubble::edem {
namespace {

std::array<std::uint64_t, 7> bitsOf(const StaticRestKey& key) {
  return {std::bit_cast<std::uint64_t>(key.gravity.x()),
          std::bit_cast<std::uint64_t>(key.gravity.y()),
          std::bit_cast<std::uint64_t>(key.gravity.z()),
          std::bit_cast<std::uint64_t>(key.youngsModulus),
          std::bit_cast<std::uint64_t>(key.density),
          std::uint64_t(key.rotationalStiffness),
          std::uint64_t(key.precision)};
}

}  // namespace

std::uint64_t hashOf(const StaticRestKey& key, const Asset& asset) {
  base::Fnv1a hash;
  for (const std::uint64_t bits : bitsOf(key)) hash.add(bits);
  for (const Eigen::Vector3d& position : asset.positions) hash.addAll(position);
  for (const double volume : asset.volumes) hash.add(volume);
  for (const AssetSpring& s : asset.springs) hash.add(s.first), hash.add(s.second), hash.add(s.area);
  for (const AssetAnchor& a : asset.anchors) hash.add(a.element), hash.add(a.area), hash.addAll(a.point);
  return hash.value();
}

const StaticRestCache::Entry* StaticRestCache::find(const std::shared_ptr<const Asset>& asset,
                                                    const StaticRestKey& key) const {
  for (const Entry& entry : m_entries)
    if (entry.asset.lock() == asset && bitsOf(entry.key) == bitsOf(key)) return &entry;
  return nullptr;
}

void StaticRestCache::add(Entry entry) {
  std::erase_if(m_entries, [](const Entry& e) { return e.asset.expired(); });
  m_entries.push_back(std::move(entry));
}

}  // namespace rubble::edem
