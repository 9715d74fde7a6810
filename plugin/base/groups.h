// What hangs together: disjoint sets of things with numbers from 0.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace rubble::base {

class Groups {
 public:
  explicit Groups(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), 0u); }

  /// The member that stands for the group of this one.
  std::uint32_t of(std::uint32_t member) {
    while (m_parent[member] != member) member = m_parent[member] = m_parent[m_parent[member]];
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) { m_parent[of(a)] = of(b); }
  std::size_t count() const {
    std::size_t groups = 0;
    for (std::uint32_t m = 0; m < m_parent.size(); ++m) groups += m_parent[m] == m ? 1 : 0;
    return groups;
  }

 private:
  std::vector<std::uint32_t> m_parent;
};

}  // namespace rubble::base
