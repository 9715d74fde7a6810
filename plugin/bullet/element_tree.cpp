#include "bullet/element_tree.h"

#include <algorithm>
#include <utility>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Boxes are larger than their elements by this share of their reach, so that what shakes or creeps stays in
// its leaf.
constexpr double kSlack = 0.2;

struct Collect : btDbvt::ICollide {
  using btDbvt::ICollide::Process;
  void Process(const btDbvtNode* leaf) { found.push_back(std::uint32_t(leaf->dataAsInt)); }
  std::vector<std::uint32_t> found;
};

}  // namespace

void ElementTree::follow(const edem::Solver& solver, std::uint32_t body) {
  const edem::BodyView view = solver.view(body);
  const auto alive = view.alive;
  const edem::CellFaces* cells = solver.cells(body);
  const double radius = solver.radius(body);
  m_leaves.resize(alive.size(), nullptr);
  m_slept.resize(alive.size(), 0);
  for (std::uint32_t i = 0; i < alive.size(); ++i) {
    btDbvtNode*& leaf = m_leaves[i];
    if (!alive[i]) {
      if (leaf) m_tree.remove(leaf);
      leaf = nullptr;
      continue;
    }
    // What sleeps has moved in the tick in which it fell asleep for the last time.
    if (std::exchange(m_slept[i], view.sleeping[i]) && view.sleeping[i] && leaf) continue;
    const double reach = cells ? cells->reach[i] : radius;
    const btVector3 at = toBullet(solver.position(body, i));
    btDbvtVolume box = btDbvtVolume::FromCR(at, btScalar(reach));
    if (leaf) {
      m_tree.update(leaf, box, btScalar(kSlack * reach));
      continue;
    }
    box.Expand(btVector3(1, 1, 1) * btScalar(kSlack * reach));
    leaf = m_tree.insert(box, nullptr);
    leaf->dataAsInt = int(i);
  }
}

std::vector<std::uint32_t> ElementTree::along(const btVector3& from, const btVector3& to,
                                              const btVector3& low, const btVector3& high) const {
  Collect collect;
  const btVector3 way = to - from;
  const btScalar length = way.length();
  if (!(length > 0)) return in(from + low, from + high);
  const btVector3 direction = way / length;
  btVector3 inverse;
  unsigned signs[3];
  for (int k = 0; k < 3; ++k) {
    inverse[k] = direction[k] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / direction[k];
    signs[k] = inverse[k] < 0;
  }
  btAlignedObjectArray<const btDbvtNode*> stack;
  m_tree.rayTestInternal(m_tree.m_root, from, to, inverse, signs, length, low, high, stack, collect);
  return std::move(collect.found);
}

std::vector<std::uint32_t> ElementTree::in(const btVector3& low, const btVector3& high) const {
  Collect collect;
  m_tree.collideTV(m_tree.m_root, btDbvtVolume::FromMM(low, high), collect);
  std::sort(collect.found.begin(), collect.found.end());
  return std::move(collect.found);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
