#include "edem/split.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "edem/fragment_motion.h"
#include "edem/frames.h"
#include "edem/stages.h"

namespace rubble::edem {
namespace {

// Leaves of a body what is `kept`; another has the rest.
template <class Real>
void keep(Body<Real>& body, const std::vector<std::uint8_t>& kept) {
  BodyState<Real>& state = body.state;
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    if (!state.alive[i] || kept[i]) continue;
    state.alive[i] = state.sleeping[i] = state.anchored[i] = 0;
    ++state.absentElements;
  }
  for (std::uint32_t s = 0; s < state.springs.size(); ++s) {
    if (!state.intact[s] || kept[state.springs[s].first]) continue;
    state.intact[s] = 0;
    ++state.absentSprings;
    if (body.isAnchor(s)) --state.anchorsIntact;
  }
}

// What follows from who is there.
template <class Real>
void relist(Body<Real>& body) {
  labelFragments(body);
  splitFrames(body);
  turnRest(body, 0);
  listAwake(body);
  body.work.motions.clear();
  body.work.awakeMotions.clear();
  beginSubstep(body.state, body.work);
  beginMotions(body);
}

}  // namespace

template <class Real>
bool maySplit(const Body<Real>& body, std::uint32_t root) {
  const BodyState<Real>& state = body.state;
  if (state.asleep || root >= body.elementCount() || state.fragment[root] != root) return false;
  return state.fragmentCount > 1 && state.frameOf[root] > 0 && !state.sleeping[root];
}

template <class Real>
std::vector<std::uint8_t> membersOf(const Body<Real>& body, std::uint32_t root) {
  std::vector<std::uint8_t> members(body.elementCount());
  for (std::size_t i = 0; i < members.size(); ++i) members[i] = body.state.fragment[i] == root;
  return members;
}

template <class Real>
Body<Real> splitOff(Body<Real>& body, const std::vector<std::uint8_t>& members, std::uint32_t id) {
  Body<Real> part = body;
  part.id = id;
  keep(part, members);
  // What has been crushed and broken was the body's.
  part.state.absentElements += std::exchange(part.state.crushedCount, 0);
  part.state.absentSprings += std::exchange(part.state.brokenCount, 0);
  part.state.easeBroken = 0;
  part.state.easeDamping = 0;
  part.state.base = {};
  part.state.farEnds = {};
  part.state.hostLoads.clear();
  part.state.parkedAt.clear();
  part.state.parkedTurn.clear();
  part.state.sleepingCount = 0;
  part.state.energyAsleep = part.state.massAsleep = 0;
  ++part.state.sleepChanges;
  relist(part);
  std::vector<std::uint8_t> others(members.size());
  std::ranges::transform(members, others.begin(), [](std::uint8_t member) { return !member; });
  keep(body, others);
  relist(body);
  return part;
}

template bool maySplit(const Body<float>&, std::uint32_t);
template bool maySplit(const Body<double>&, std::uint32_t);
template std::vector<std::uint8_t> membersOf(const Body<float>&, std::uint32_t);
template std::vector<std::uint8_t> membersOf(const Body<double>&, std::uint32_t);
template Body<float> splitOff(Body<float>&, const std::vector<std::uint8_t>&, std::uint32_t);
template Body<double> splitOff(Body<double>&, const std::vector<std::uint8_t>&, std::uint32_t);

}  // namespace rubble::edem
