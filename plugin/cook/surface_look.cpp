#include "cook/surface_look.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "base/material_name.h"
#include "cook/corner_normals.h"

namespace rubble::cooking {
namespace {

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  text << "mesh: ";
  (text << ... << parts);
  throw Error(text.str());
}

void checkLength(const SurfaceMesh& mesh, std::size_t length, const char* list) {
  if (length != 0 && length != mesh.triangles.size())
    refuse(length, " ", list, " for ", mesh.triangles.size(), " triangles; allowed: none or one a triangle");
}

template <class Corners>
void checkFinite(const std::vector<Corners>& list, const char* what) {
  for (std::size_t t = 0; t < list.size(); ++t)
    for (const auto& corner : list[t])
      if (!corner.allFinite()) refuse(what, " of triangle ", t, " are not finite");
}

void checkMaterials(const SurfaceMesh& mesh) {
  const std::size_t names = mesh.materialNames.size();
  if (names > base::kMostMaterials) refuse(names, " materials; allowed: up to ", base::kMostMaterials);
  for (std::size_t m = 0; m < names; ++m)
    if (!base::isMaterialName(mesh.materialNames[m]))
      refuse("the name of material ", m, " is none; allowed: ", base::kMaterialNames);
  for (std::size_t t = 0; t < mesh.materials.size(); ++t)
    if (mesh.materials[t] >= names)
      refuse("triangle ", t, " has material ", mesh.materials[t], "; allowed: those that have a name, ",
             names);
}

}  // namespace

void checkLook(const SurfaceMesh& mesh) {
  checkLength(mesh, mesh.normals.size(), "sets of normals");
  checkLength(mesh, mesh.uvs.size(), "sets of texture coordinates");
  checkLength(mesh, mesh.materials.size(), "materials");
  checkFinite(mesh.normals, "normals");
  checkFinite(mesh.uvs, "texture coordinates");
  checkMaterials(mesh);
}

SurfaceLook::SurfaceLook(const SurfaceMesh& mesh, const CheckedMesh& solid)
    : m_mesh(mesh), m_solid(solid), m_normals(cornerNormals(solid)) {
  for (std::size_t t = 0; t < mesh.normals.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d given = mesh.normals[t][k].cast<double>();
      if (!given.isZero(0)) m_normals[t][k] = given.stableNormalized();
    }
}

// Of the triangles between the place and the side across each corner: the corner's weight. Twice the areas
// [m^2].
std::array<double, 3> SurfaceLook::areasAcross(std::uint32_t triangle, const Eigen::Vector3d& place) const {
  const auto& [i, j, k] = m_solid.triangles[triangle];
  const Eigen::Vector3d& a = m_solid.vertices[i];
  const Eigen::Vector3d& b = m_solid.vertices[j];
  const Eigen::Vector3d& c = m_solid.vertices[k];
  const Eigen::Vector3d& flat = m_solid.normals[triangle];
  return {std::max(0.0, flat.dot((b - place).cross(c - place))),
          std::max(0.0, flat.dot((c - place).cross(a - place))),
          std::max(0.0, flat.dot((a - place).cross(b - place)))};
}

Eigen::Vector3d SurfaceLook::normal(std::uint32_t triangle, const Eigen::Vector3d& place) const {
  const auto& normals = m_normals[triangle];
  if (normals[0] == normals[1] && normals[1] == normals[2]) return normals[0];
  const auto [atA, atB, atC] = areasAcross(triangle, place);
  const Eigen::Vector3d sum = atA * normals[0] + atB * normals[1] + atC * normals[2];
  const double length = sum.norm();
  return length > 0 ? Eigen::Vector3d(sum / length) : m_solid.normals[triangle];
}

Eigen::Vector2f SurfaceLook::uv(std::uint32_t triangle, const Eigen::Vector3d& place) const {
  const auto& uvs = m_mesh.uvs[triangle];
  const auto [atA, atB, atC] = areasAcross(triangle, place);
  const double sum = atA + atB + atC;
  if (!(sum > 0)) return uvs[0];  // a triangle without area
  const Eigen::Vector2d mean = atA / sum * uvs[0].cast<double>() + atB / sum * uvs[1].cast<double>() +
                               atC / sum * uvs[2].cast<double>();
  return mean.cast<float>();
}

}  // namespace rubble::cooking
