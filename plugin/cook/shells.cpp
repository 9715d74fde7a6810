#include "cook/shells.h"

#include <Eigen/Geometry>

#include "base/groups.h"

namespace rubble::cooking {

double volumeAbout(const Soup& soup, std::uint32_t triangle, const Eigen::Vector3d& origin) {
  const auto& [a, b, c] = soup.triangles[triangle];
  return (soup.vertices[a] - origin).dot((soup.vertices[b] - origin).cross(soup.vertices[c] - origin)) / 6;
}

Shells findShells(const Soup& soup) {
  base::Groups groups(soup.vertices.size());
  for (const auto& [a, b, c] : soup.triangles) {
    groups.join(a, b);
    groups.join(b, c);
  }
  Shells shells;
  std::vector<std::uint32_t> shellOf(soup.vertices.size(), kNoElement);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    std::uint32_t& shell = shellOf[groups.of(soup.triangles[t][0])];
    if (shell == kNoElement) {
      shell = std::uint32_t(shells.list.size());
      shells.list.emplace_back();
    }
    Shell& own = shells.list[shell];
    own.triangles.push_back(t);
    const Eigen::Vector3d& origin = soup.vertices[soup.triangles[own.triangles[0]][0]];
    own.volume += volumeAbout(soup, t, origin);
    for (const std::uint32_t v : soup.triangles[t]) own.bounds.extend(soup.vertices[v]);
    shells.of.push_back(shell);
  }
  return shells;
}

double volumeOf(const Soup& soup) {
  double volume = 0;
  for (const Shell& shell : findShells(soup).list) volume += shell.volume;
  return volume;
}

void appendSoup(const Soup& added, Soup& soup) {
  const auto first = std::uint32_t(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), added.vertices.begin(), added.vertices.end());
  for (const auto& [a, b, c] : added.triangles) soup.triangles.push_back({first + a, first + b, first + c});
  soup.sources.insert(soup.sources.end(), added.sources.begin(), added.sources.end());
}

}  // namespace rubble::cooking
