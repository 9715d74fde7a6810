#include "edem/body.h"

#include <algorithm>
#include <numeric>

namespace rubble::edem {

template <class Real>
void listAwake(Body<Real>& body) {
  body.work.awake.clear();
  for (std::uint32_t i = 0; i < body.elementCount(); ++i)
    if (body.state.alive[i] && !body.state.sleeping[i]) body.work.awake.push_back(i);
  body.work.awakeSprings.clear();
  for (std::uint32_t s = 0; s < body.state.springs.size(); ++s)
    if (body.state.intact[s] && !body.state.sleeping[body.state.springs[s].first])
      body.work.awakeSprings.push_back(s);
}

template <class Real>
std::uint32_t labelFragments(Body<Real>& body) {
  std::vector<std::uint32_t>& root = body.state.fragment;
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t s = 0; s < body.constants->anchorBegin; ++s) {
    if (!body.state.intact[s]) continue;
    const std::uint32_t a = find(body.state.springs[s].first), b = find(body.state.springs[s].second);
    if (a != b) root[std::max(a, b)] = std::min(a, b);
  }
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < root.size(); ++i) {
    root[i] = body.state.alive[i] ? find(i) : kNoElement;
    if (root[i] == i) ++count;
  }
  body.state.labelledBroken = body.state.brokenCount;
  return body.state.fragmentCount = count;
}

template void listAwake(Body<float>&);
template void listAwake(Body<double>&);
template std::uint32_t labelFragments(Body<float>&);
template std::uint32_t labelFragments(Body<double>&);

}  // namespace rubble::edem
