#include "cook/box_pairs.h"

#include <algorithm>
#include <numeric>

namespace rubble::cooking {
namespace {

constexpr std::uint32_t kBoxesInLeaf = 8;
constexpr std::size_t kVisit = 16;  // as long as so many comparisons

// Halves the boxes along the axis in which their middles lie farthest apart, and compares half with half.
class OverlapTree {
 public:
  OverlapTree(const std::vector<Eigen::AlignedBox3d>& boxes, std::size_t mostTests,
              const std::function<void(std::uint32_t, std::uint32_t)>& visit)
      : m_boxes(boxes), m_left(mostTests), m_visit(visit), m_order(boxes.size()) {
    std::iota(m_order.begin(), m_order.end(), 0u);
    build(0, std::uint32_t(boxes.size()));
  }

  bool run() { return within(0); }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first, count;  // in the order
    std::uint32_t right;         // child, 0: a leaf; the left one is the next node
  };

  void build(std::uint32_t first, std::uint32_t count) {
    const std::size_t node = m_nodes.size();
    m_nodes.push_back({{}, first, count, 0});
    Eigen::AlignedBox3d middles;
    for (std::uint32_t k = first; k < first + count; ++k) {
      m_nodes[node].box.extend(m_boxes[m_order[k]]);
      middles.extend(m_boxes[m_order[k]].center());
    }
    if (count <= kBoxesInLeaf) return;
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const auto begin = m_order.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [this, axis](std::uint32_t s, std::uint32_t t) {
      const double atS = m_boxes[s].min()[axis] + m_boxes[s].max()[axis];
      const double atT = m_boxes[t].min()[axis] + m_boxes[t].max()[axis];
      return atS != atT ? atS < atT : s < t;
    });
    build(first, count / 2);
    m_nodes[node].right = std::uint32_t(m_nodes.size());
    build(first + count / 2, count - count / 2);
  }

  bool within(std::uint32_t index) {
    const Node& node = m_nodes[index];
    if (node.right != 0) return within(index + 1) && within(node.right) && between(index + 1, node.right);
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      if (!compare(m_order[k], k + 1, node.first + node.count)) return false;
    return true;
  }

  bool between(std::uint32_t one, std::uint32_t other) {
    const Node &a = m_nodes[one], &b = m_nodes[other];
    if (m_left-- == 0) return false;
    if (!a.box.intersects(b.box)) return true;
    if (a.right == 0 && b.right == 0) {
      for (std::uint32_t k = a.first; k < a.first + a.count; ++k)
        if (b.box.intersects(m_boxes[m_order[k]]) && !compare(m_order[k], b.first, b.first + b.count))
          return false;
      return true;
    }
    // The larger one is opened.
    if (b.right == 0 || (a.right != 0 && a.count >= b.count))
      return between(one + 1, other) && between(a.right, other);
    return between(one, other + 1) && between(one, b.right);
  }

  bool compare(std::uint32_t box, std::uint32_t first, std::uint32_t end) {
    if (m_left < end - first) return false;
    m_left -= end - first;
    for (std::uint32_t k = first; k < end; ++k) {
      const std::uint32_t other = m_order[k];
      if (!m_boxes[box].intersects(m_boxes[other])) continue;
      if (m_left < kVisit) return false;
      m_left -= kVisit;
      m_visit(std::min(box, other), std::max(box, other));
    }
    return true;
  }

  const std::vector<Eigen::AlignedBox3d>& m_boxes;
  std::size_t m_left;
  const std::function<void(std::uint32_t, std::uint32_t)>& m_visit;
  std::vector<std::uint32_t> m_order;
  std::vector<Node> m_nodes;
};

}  // namespace

bool visitOverlaps(const std::vector<Eigen::AlignedBox3d>& boxes, std::size_t mostTests,
                   const std::function<void(std::uint32_t, std::uint32_t)>& visit) {
  return boxes.empty() || OverlapTree(boxes, mostTests, visit).run();
}

}  // namespace rubble::cooking
