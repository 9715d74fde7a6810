#include "cook/voronoi_edges.h"

#include <algorithm>
#include <numeric>

#include "cook/contradiction.h"
namespace rubble::cooking {
namespace {

using Hit = SurfacePieces::Hit;

enum class State : std::uint8_t { Unknown, Outside, Inside };

// The hits of all edges, in the order of the edges and along each of them; edge e has [start[e], start[e +
// 1]).
struct EdgeHits {
  std::vector<Hit> hits;
  std::vector<std::uint32_t> start;

  std::span<const Hit> of(std::uint32_t edge) const {
    return std::span(hits).subspan(start[edge], start[edge + 1] - start[edge]);
  }
};

void sortAlong(const VoronoiDiagram& diagram, const VoronoiEdge& edge, const VertexPool& pool,
               std::span<Hit> hits) {
  if (hits.size() < 2) return;
  const Eigen::Vector3d& origin = diagram.points[edge.sites[0]];
  const Eigen::Vector3d direction =
      (diagram.points[edge.sites[1]] - origin).cross(diagram.points[edge.sites[2]] - origin);
  std::sort(hits.begin(), hits.end(), [&](const Hit& a, const Hit& b) {
    const double alongA = direction.dot(pool.positions()[a.vertex] - origin);
    const double alongB = direction.dot(pool.positions()[b.vertex] - origin);
    return alongA != alongB ? alongA < alongB : a.vertex < b.vertex;
  });
  for (std::size_t h = 1; h < hits.size(); ++h)
    if (hits[h].leaving == hits[h - 1].leaving)
      throw Contradiction("a Voronoi edge enters the solid twice in a row");
}

EdgeHits assignHits(const VoronoiDiagram& diagram, const SurfacePieces& pieces, const VertexPool& pool) {
  EdgeHits result{pieces.hits, {}};
  std::stable_sort(result.hits.begin(), result.hits.end(),
                   [](const Hit& a, const Hit& b) { return a.sites < b.sites; });
  std::uint32_t at = 0;
  for (const VoronoiEdge& edge : diagram.edges) {
    result.start.push_back(at);
    while (at < result.hits.size() && result.hits[at].sites == edge.sites) ++at;
    sortAlong(diagram, edge, pool,
              std::span(result.hits).subspan(result.start.back(), at - result.start.back()));
  }
  result.start.push_back(at);
  if (at != result.hits.size()) throw Contradiction("three cells meet on the surface that meet nowhere else");
  return result;
}

// Voronoi vertices joined by edges that the surface does not cross share one state.
class VertexStates {
 public:
  explicit VertexStates(std::size_t count) : m_parent(count), m_state(count, State::Unknown) {
    std::iota(m_parent.begin(), m_parent.end(), 0u);
  }

  std::uint32_t root(std::uint32_t vertex) {
    while (m_parent[vertex] != vertex) vertex = m_parent[vertex] = m_parent[m_parent[vertex]];
    return vertex;
  }
  void join(std::uint32_t a, std::uint32_t b) { m_parent[root(a)] = root(b); }
  void set(std::uint32_t vertex, State state) {
    State& known = m_state[root(vertex)];
    if (known != State::Unknown && known != state)
      throw Contradiction("a Voronoi vertex is both inside and outside");
    known = state;
  }
  bool isInside(std::uint32_t vertex) {
    const State state = m_state[root(vertex)];
    if (state == State::Unknown) throw Contradiction("a Voronoi vertex is neither inside nor outside");
    return state == State::Inside;
  }

 private:
  std::vector<std::uint32_t> m_parent;
  std::vector<State> m_state;
};

VertexStates findStates(const VoronoiDiagram& diagram, const EdgeHits& edgeHits) {
  VertexStates states(diagram.vertices.size());
  for (std::uint32_t e = 0; e < diagram.edges.size(); ++e)
    if (edgeHits.of(e).empty()) states.join(diagram.edges[e].from, diagram.edges[e].to);
  for (std::uint32_t v = 0; v < diagram.vertices.size(); ++v)
    if (diagram.isFar(v)) states.set(v, State::Outside);
  for (std::uint32_t e = 0; e < diagram.edges.size(); ++e) {
    const auto hits = edgeHits.of(e);
    if (hits.empty()) continue;
    states.set(diagram.edges[e].from, hits.front().leaving ? State::Inside : State::Outside);
    states.set(diagram.edges[e].to, hits.back().leaving ? State::Outside : State::Inside);
  }
  return states;
}

}  // namespace

std::vector<InsideStretch> insideStretches(const VoronoiDiagram& diagram, const SurfacePieces& pieces,
                                           VertexPool& pool) {
  const EdgeHits edgeHits = assignHits(diagram, pieces, pool);
  VertexStates states = findStates(diagram, edgeHits);
  std::vector<InsideStretch> stretches;
  for (std::uint32_t e = 0; e < diagram.edges.size(); ++e) {
    const VoronoiEdge& edge = diagram.edges[e];
    std::uint32_t from = states.isInside(edge.from) ? pool.voronoiVertex(edge.from) : kNoElement;
    for (const Hit& hit : edgeHits.of(e)) {
      if (hit.leaving) {
        stretches.push_back({e, from, hit.vertex});
      } else {
        from = hit.vertex;
      }
    }
    if (states.isInside(edge.to)) stretches.push_back({e, from, pool.voronoiVertex(edge.to)});
  }
  return stretches;
}

}  // namespace rubble::cooking
