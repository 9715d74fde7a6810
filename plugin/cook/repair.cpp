// What is done in which order, and the words for it; the mending itself is in the files named by what they
// mend.
#include "rubble/repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "cook/checked_mesh.h"
#include "cook/mend_surface.h"
#include "cook/soup.h"
#include "cook/spare_triangles.h"
#include "cook/surface_check.h"
#include "cook/surface_look.h"
#include "cook/surface_sides.h"
#include "cook/weld.h"

namespace rubble {
namespace {

using namespace cooking;

constexpr double kLargestWeldDistance = 0.01;  // [diagonal]; more eats walls

template <class... Parts>
std::string words(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

std::string counted(std::size_t count, const std::string& noun) {
  return words(count, ' ', noun, count == 1 ? "" : "s");
}

void checkOptions(const RepairOptions& options) {
  const auto require = [](bool holds, const char* option, double value, const std::string& allowed) {
    if (!holds) throw Error(words("repair: ", option, " is ", value, "; allowed: ", allowed));
  };
  require(options.weldDistance >= 0 && options.weldDistance <= kLargestWeldDistance, "weldDistance",
          options.weldDistance, "0 to 0.01");
  require(options.largestHole >= 0 && options.largestHole <= 1, "largestHole", options.largestHole, "0 to 1");
}

// The triangles given, once their corners are welded: what the surface looks like is known there.
struct Base {
  Base(const SurfaceMesh& mesh, const Soup& soup) : vertices(soup.vertices), triangles(mesh.triangles) {
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      triangles[soup.sources[t].triangle] = soup.triangles[t];
  }

  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  Eigen::Vector3d areaOf(std::uint32_t t) const {
    const auto& [a, b, c] = triangles[t];
    return (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]) / 2;
  }
};

Soup soupOf(const SurfaceMesh& mesh) {
  Soup soup{mesh.vertices, mesh.triangles, {}};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) soup.sources.push_back({t, false});
  return soup;
}

double diagonalOf(const SurfaceMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) bounds.extend(mesh.vertices[v]);
  return bounds.diagonal().norm();
}

// Vertices that no triangle uses go.
void dropUnused(Soup& soup) {
  std::vector<std::uint32_t> ids(soup.vertices.size(), kNoElement);
  std::vector<Eigen::Vector3d> used;
  for (auto& triangle : soup.triangles)
    for (std::uint32_t& v : triangle) {
      if (ids[v] == kNoElement) {
        ids[v] = std::uint32_t(used.size());
        used.push_back(soup.vertices[v]);
      }
      v = ids[v];
    }
  soup.vertices = std::move(used);
}

bool isTurned(const Base& base, const Soup& soup, std::size_t t) {
  if (soup.sources[t].isPatch) return false;
  const auto& [a, b, c] = soup.triangles[t];
  const Eigen::Vector3d area =
      (soup.vertices[b] - soup.vertices[a]).cross(soup.vertices[c] - soup.vertices[a]);
  return area.dot(base.areaOf(soup.sources[t].triangle)) < 0;
}

std::size_t countTurned(const Base& base, const Soup& soup) {
  std::vector<std::uint32_t> turned;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (isTurned(base, soup, t)) turned.push_back(soup.sources[t].triangle);
  std::sort(turned.begin(), turned.end());
  return std::size_t(std::unique(turned.begin(), turned.end()) - turned.begin());
}

// Shares of the three corners of a triangle of the base in a place on it; whole at the corners themselves.
std::array<float, 3> sharesAt(const Base& base, std::uint32_t t, const Eigen::Vector3d& place) {
  for (std::size_t k = 0; k < 3; ++k)
    if (place == base.vertices[base.triangles[t][k]])
      return {k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
  const Eigen::Vector3d area = base.areaOf(t);
  std::array<float, 3> shares{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& b = base.vertices[base.triangles[t][(k + 1) % 3]];
    const Eigen::Vector3d& c = base.vertices[base.triangles[t][(k + 2) % 3]];
    const double share = (b - place).cross(c - place).dot(area) / (2 * area.squaredNorm());
    shares[k] = std::isfinite(share) ? float(share) : 1.0f / 3;
  }
  return shares;
}

template <class Corners>
Corners mixed(const Corners& given, const std::array<std::array<float, 3>, 3>& shares) {
  Corners corners = given;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    corners[corner].setZero();
    for (std::size_t k = 0; k < 3; ++k)
      if (shares[corner][k] != 0) corners[corner] += shares[corner][k] * given[k];
  }
  return corners;
}

SurfaceMesh meshOf(const SurfaceMesh& given, const Base& base, const Soup& soup) {
  SurfaceMesh mesh;
  mesh.vertices = soup.vertices;
  mesh.triangles = soup.triangles;
  mesh.materialNames = given.materialNames;
  const auto zero3 = Eigen::Vector3f::Zero();
  const auto zero2 = Eigen::Vector2f::Zero();
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [source, isPatch] = soup.sources[t];
    if (!given.materials.empty()) mesh.materials.push_back(given.materials[source]);
    std::array<std::array<float, 3>, 3> shares{};
    if (!isPatch && !(given.normals.empty() && given.uvs.empty()))
      for (std::size_t k = 0; k < 3; ++k)
        shares[k] = sharesAt(base, source, soup.vertices[soup.triangles[t][k]]);
    if (!given.normals.empty()) {
      auto& normals = mesh.normals.emplace_back(std::array<Eigen::Vector3f, 3>{zero3, zero3, zero3});
      if (!isPatch) normals = mixed(given.normals[source], shares);
      if (isTurned(base, soup, t))
        for (Eigen::Vector3f& normal : normals) normal = -normal;
    }
    if (!given.uvs.empty()) {
      auto& uvs = mesh.uvs.emplace_back(std::array<Eigen::Vector2f, 3>{zero2, zero2, zero2});
      if (!isPatch) uvs = mixed(given.uvs[source], shares);
    }
  }
  return mesh;
}

void tellWelds(const Welded& welded, std::vector<std::string>& done) {
  if (welded.before > 0) done.push_back(words("welded ", welded.before, " corners to ", welded.after));
}

void tellHoles(const Mended& mended, bool hasLook, RepairedMesh& repaired) {
  const auto sum = [](const std::vector<Hole>& holes) {
    Hole all;
    for (const Hole& hole : holes) {
      all.edges += hole.edges;
      all.area += hole.area;
    }
    return all;
  };
  const auto tell = [&](const char* verb, const std::vector<Hole>& holes) {
    const Hole all = sum(holes);
    return words(verb, counted(holes.size(), "hole"), " of ", counted(all.edges, "edge"), ", ", all.area,
                 " m^2");
  };
  if (!mended.holes.filled.empty())
    repaired.done.push_back(tell("filled ", mended.holes.filled) +
                            (hasLook ? ", without normals and texture coordinates" : ""));
  if (!mended.holes.tooLarge.empty())
    repaired.left.push_back(tell("left open ", mended.holes.tooLarge) + "; too large to be closed by guess");
}

// What the checks of `cook` say of it; empty where they have nothing to say.
std::string faultOf(const SurfaceMesh& mesh) {
  try {
    checkSurface(checkMesh(mesh));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

RepairedMesh repair(const SurfaceMesh& mesh, const RepairOptions& options) {
  checkOptions(options);
  checkNumbers(mesh);
  checkLook(mesh);
  RepairedMesh repaired;
  std::vector<std::string>& done = repaired.done;
  const double distance = options.weldDistance * diagonalOf(mesh);
  Soup soup = soupOf(mesh);
  const std::size_t copies = dropCopies(soup);  // they would make open edges look closed
  tellWelds(weld(soup, distance), done);
  const Base base(mesh, soup);
  if (const std::size_t flat = dropFlat(soup))
    done.push_back(words("left out ", counted(flat, "triangle"), " without area"));
  if (const std::size_t doubled = copies + dropDoubled(soup))
    done.push_back(words("left out ", counted(doubled, "triangle"), " that stood twice"));
  if (const std::size_t split = splitAtCorners(soup, distance))
    done.push_back(words("cut ", counted(split, "triangle"), " at corners that lie on their edges"));

  const bool hasLook = !mesh.normals.empty() || !mesh.uvs.empty();
  const std::size_t corners = soup.vertices.size();
  if (const auto sided = makeSided(soup)) {
    if (sided->parted > 0)
      done.push_back(words("parted ", counted(sided->parted, "edge"), " of more than two triangles"));
    else if (const std::size_t touching = soup.vertices.size() - corners)
      done.push_back(words("parted ", counted(touching, "corner"), " in which alone surfaces touched"));
    const Mended mended = mendSurface(soup, options);
    tellHoles(mended, hasLook, repaired);
    if (mended.united > 0)
      done.push_back(words("united ", mended.united, " parts that overlap or touch to ", mended.remaining));
    for (const auto& [parts, why] : mended.notUnited)
      repaired.left.push_back(words("did not unite ", counted(parts, "part"), " that overlap: ", why));
    if (mended.crossings > 0)
      repaired.left.push_back(words("passes through itself: ", counted(mended.crossings, "pair"),
                                    " of triangles, the first near (", mended.crossing.x(), ", ",
                                    mended.crossing.y(), ", ", mended.crossing.z(), ')'));
  }
  if (const std::size_t turned = countTurned(base, soup))
    done.push_back(words("turned ", counted(turned, "triangle")));
  if (done.empty()) {
    repaired.mesh = mesh;
  } else {
    dropUnused(soup);
    repaired.mesh = meshOf(mesh, base, soup);
  }
  repaired.fault = faultOf(repaired.mesh);
  return repaired;
}

}  // namespace rubble
