// What lies within a closed surface, and what lies on it but for a rounding.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>

#include "cook/shells.h"

namespace rubble::cooking {

enum class ShellSide { Within, On, Outside };

class ShellTree {
 public:
  ShellTree(const Soup& soup, const Shell& shell);
  ~ShellTree();

  ShellSide sideOf(const Eigen::Vector3d& place) const;
  /// Whether a triangle meets the cube of half an edge `reach` about a place [m].
  bool isNear(const Eigen::Vector3d& place, double reach) const;

 private:
  struct Trees;
  std::unique_ptr<Trees> m_trees;
};

/// Whether all of `inner` lies within `outer`, where they do not cross.
bool liesWithin(const Soup& soup, const Shell& inner, const ShellTree& outer);

/// Trees of shells, each built when first asked for.
class ShellTrees {
 public:
  ShellTrees(const Soup& soup, const Shells& shells) : m_soup(soup), m_shells(shells) {}
  const ShellTree& of(std::uint32_t shell) {
    return m_trees.try_emplace(shell, m_soup, m_shells.list[shell]).first->second;
  }

 private:
  const Soup& m_soup;
  const Shells& m_shells;
  std::map<std::uint32_t, ShellTree> m_trees;
};

}  // namespace rubble::cooking
