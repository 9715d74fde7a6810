#include "cook/parts.h"

#include <algorithm>

#include "base/groups.h"

namespace rubble::cooking {

std::size_t countParts(const CheckedMesh& mesh) {
  base::Groups shells(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t neighbour : mesh.neighbours[t]) shells.join(t, neighbour);
  std::vector<double> volumes(mesh.triangles.size(), 0);
  const Eigen::Vector3d origin = mesh.bounds.center();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    volumes[shells.of(t)] +=
        (mesh.vertices[a] - origin).dot((mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin));
  }
  return std::size_t(std::count_if(volumes.begin(), volumes.end(), [](double volume) { return volume > 0; }));
}

std::size_t countTied(std::size_t elements, std::span<const AssetSpring> springs) {
  base::Groups tied(elements);
  for (const AssetSpring& spring : springs) tied.join(spring.first, spring.second);
  return tied.count();
}

}  // namespace rubble::cooking
