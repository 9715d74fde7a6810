#include "cook/surface_check.h"

#include <sstream>
#include <vector>

#include "base/groups.h"
#include "cook/nesting.h"
#include "cook/surface_clash.h"

namespace rubble::cooking {
namespace {

// What is less deep is a rounding, of files of floats as well [diagonal]: see RepairOptions::weldDistance.
constexpr double kDepth = 1e-6;
// Where the cells cannot be cut, what is above the rounding of doubles counts.
constexpr double kLeastDepth = 1e-13;

template <class... Words>
std::string sentence(const Words&... words) {
  std::ostringstream text;
  (text << ... << words);
  return text.str();
}

std::string at(const Eigen::Vector3d& p) {
  return sentence("at (", p.x(), ", ", p.y(), ", ", p.z(), ')');
}

// Numbers of the closed surfaces of triangles, in the order of their first triangles.
std::vector<std::uint32_t> partsOf(const CheckedMesh& mesh) {
  base::Groups groups(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t neighbour : mesh.neighbours[t]) groups.join(t, neighbour);
  std::vector<std::uint32_t> numberOf(mesh.triangles.size(), kNoElement), parts;
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& number = numberOf[groups.of(t)];
    if (number == kNoElement) number = count++;
    parts.push_back(number);
  }
  return parts;
}

std::string describe(const CheckedMesh& mesh, const Clash& clash, const Eigen::Vector3d& origin) {
  const auto [s, t] = clash.triangles;
  const std::vector<std::uint32_t> parts = partsOf(mesh);
  const std::string triangles = sentence("triangles ", s, " and ", t);
  const std::string where = at(clash.place + origin);
  const bool isOnePart = parts[s] == parts[t];
  const std::string whose =
      isOnePart ? sentence("part ", parts[s]) : sentence("parts ", parts[s], " and ", parts[t]);
  const std::string what =
      isOnePart ? "; a repair does not mend one part, its maker must" : "; a repair unites such parts";
  switch (clash.kind) {
    case Clash::Kind::Crossing:
      return sentence("passes through itself: ", triangles, ", of ", whose, ", cross ", where, what);
    case Clash::Kind::Doubled:
      return sentence("two sheets of surface in the same place: ", triangles, ", of ", whose,
                      ", lie on each other ", where, " and face the same way; remove one of them, or ",
                      isOnePart ? "mend that part" : "let a repair unite the parts");
    case Clash::Kind::Touching:
      break;
  }
  return sentence("two sheets of surface in the same place: ", triangles, ", of ", whose, ", touch ", where,
                  ", with nothing between them", what);
}

std::string describe(const WrongShell& wrong) {
  const std::string where = at(wrong.place);
  if (wrong.around == kNoElement)
    return sentence("part ", wrong.shell, ", with a corner ", where,
                    ", faces inwards, but lies inside no other; turn it outwards, as a repair does");
  if (wrong.isInward)
    return sentence("part ", wrong.shell, " inside part ", wrong.around, ", with a corner ", where,
                    ", faces inwards, but that is a cavity already; turn it outwards, as a repair does");
  return sentence("part ", wrong.shell, " inside part ", wrong.around, ", with a corner ", where,
                  ", faces the same way: outwards within the solid; turn it inwards, as a repair does, if it "
                  "is a cavity, else remove it");
}

}  // namespace

void checkSurface(const CheckedMesh& mesh) {
  if (const auto clash = findClash(mesh, kDepth * mesh.diagonal()))
    throw Error("mesh: " + describe(mesh, *clash, Eigen::Vector3d::Zero()));
  if (const auto wrong =
          findWrongShell({mesh.vertices, mesh.triangles, std::vector<Source>(mesh.triangles.size())}))
    throw Error("mesh: " + describe(*wrong));
}

std::string whyNotCut(const CheckedMesh& mesh, const Eigen::Vector3d& origin) {
  if (const auto contact = findContact(mesh, kLeastDepth * mesh.diagonal()))
    return describe(mesh, *contact, origin);
  return "";
}

}  // namespace rubble::cooking
