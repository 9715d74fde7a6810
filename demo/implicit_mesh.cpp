// Each cube of the grid is six tetrahedra about its diagonal (Kuhn), and each of these is cut by a triangle
// or two where the field changes its sign. A table of cubes (marching cubes) has fewer triangles, but some of
// its cases leave holes between two cubes; tetrahedra have none.
#include "demo/implicit_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <unordered_map>
#include <vector>

namespace rubble::demo {
namespace {

// Cuts keep this far from the ends of an edge [edge]: nearer ones make needles that nobody sees.
constexpr double kNearest = 0.1;

// Corners of the six tetrahedra; bit 0 of a corner is its x, 1 its y, 2 its z.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                   {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class Polygoniser {
 public:
  Polygoniser(const Field& field, const SampleGrid& grid) : m_grid(grid) {
    const auto& [nx, ny, nz] = grid.counts;
    m_values.reserve(std::size_t(nx) * std::size_t(ny) * std::size_t(nz));
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
          m_places.push_back(grid.origin + grid.spacing * Eigen::Vector3d(x, y, z));
          m_values.push_back(field(m_places.back()));
        }
    for (int z = 0; z + 1 < nz; ++z)
      for (int y = 0; y + 1 < ny; ++y)
        for (int x = 0; x + 1 < nx; ++x) cutCube(x, y, z);
  }
  SurfaceMesh take() && { return std::move(m_mesh); }

 private:
  using Sample = std::uint32_t;

  Sample sample(int x, int y, int z) const {
    return Sample((z * m_grid.counts[1] + y) * m_grid.counts[0] + x);
  }
  bool isInside(Sample s) const { return m_values[s] < 0; }

  void cutCube(int x, int y, int z) {
    for (const auto& corners : kTetrahedra) {
      std::vector<Sample> inside, outside;
      for (const int corner : corners) {
        const Sample s = sample(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1));
        (isInside(s) ? inside : outside).push_back(s);
      }
      cutTetrahedron(inside, outside);
    }
  }
  void cutTetrahedron(const std::vector<Sample>& in, const std::vector<Sample>& out) {
    if (in.empty() || out.empty()) return;
    const Eigen::Vector3d outwards = meanOf(out) - meanOf(in);
    std::vector<std::uint32_t> around;  // corners of the cut, one after the other
    for (const Sample a : in)
      for (const Sample b : out) around.push_back(cut(a, b));
    if (around.size() == 4) std::swap(around[2], around[3]);  // two against two
    addTriangle(around[0], around[1], around[2], outwards);
    if (around.size() == 4) addTriangle(around[0], around[2], around[3], outwards);
  }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Eigen::Vector3d& outwards) {
    const auto& v = m_mesh.vertices;
    const bool isOutward = (v[b] - v[a]).cross(v[c] - v[a]).dot(outwards) > 0;
    if (isOutward) {
      m_mesh.triangles.push_back({a, b, c});
    } else {
      m_mesh.triangles.push_back({a, c, b});
    }
  }
  Eigen::Vector3d meanOf(const std::vector<Sample>& samples) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Sample s : samples) sum += m_places[s];
    return sum / double(samples.size());
  }
  // The vertex on the edge between two samples, one inside and one outside.
  std::uint32_t cut(Sample in, Sample out) {
    const std::uint64_t edge = std::uint64_t(std::min(in, out)) << 32 | std::max(in, out);
    const auto [entry, isNew] = m_cuts.try_emplace(edge, std::uint32_t(m_mesh.vertices.size()));
    if (isNew) {
      const double share = m_values[in] / (m_values[in] - m_values[out]);
      m_mesh.vertices.push_back(m_places[in] +
                                std::clamp(share, kNearest, 1 - kNearest) * (m_places[out] - m_places[in]));
    }
    return entry->second;
  }

  SampleGrid m_grid;
  std::vector<Eigen::Vector3d> m_places;
  std::vector<double> m_values;
  std::unordered_map<std::uint64_t, std::uint32_t> m_cuts;
  SurfaceMesh m_mesh;
};

}  // namespace

SurfaceMesh implicitMesh(const Field& field, const SampleGrid& grid) {
  return Polygoniser(field, grid).take();
}

}  // namespace rubble::demo
