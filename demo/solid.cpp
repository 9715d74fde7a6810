#include "demo/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>
#include <utility>

#include "rubble/repair.h"

namespace rubble::demo {
namespace {

// Most buildings are shorter, and what is drawn in millimetres and larger than 0.1 m is longer [m].
constexpr double kLongest = 100;

Eigen::AlignedBox3d boundsOf(const SurfaceMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) bounds.extend(mesh.vertices[corner]);
  return bounds;
}

double acrossOf(const SurfaceMesh& mesh) {
  const Eigen::AlignedBox3d bounds = boundsOf(mesh);
  return bounds.isEmpty() ? 0 : bounds.diagonal().norm();
}

}  // namespace

SurfaceMesh readSolid(const std::filesystem::path& file, double scale) {
  SurfaceMesh mesh = readMesh(file, scale);
  const double across = acrossOf(mesh);
  if (limits::kLength.hold(across)) return mesh;
  std::ostringstream text;
  text << file.string() << ": is " << across << " m across with " << scale << " m a unit, must be "
       << limits::kLength.text() << " m; a scale changes it";
  throw Error(text.str());
}

std::string unitAdvice(const SurfaceMesh& mesh, const std::string& way) {
  const Eigen::AlignedBox3d bounds = boundsOf(mesh);
  const double longest = bounds.isEmpty() ? 0 : bounds.sizes().maxCoeff();
  if (longest <= kLongest) return "";
  std::ostringstream text;
  text << "is " << longest << " m long; if its units are millimetres, " << way;
  return text.str();
}

SurfaceMesh repairSolid(const SurfaceMesh& mesh, const LogFunction& log) {
  RepairedMesh repaired = repair(mesh);
  for (const std::string& line : repaired.done) log(LogLevel::Info, line);
  for (const std::string& line : repaired.left) log(LogLevel::Info, line);
  if (repaired.done.empty() && repaired.left.empty() && repaired.fault.empty())
    log(LogLevel::Info, "nothing to repair");
  return std::move(repaired.mesh);
}

std::string repairHint(const SurfaceMesh& mesh, const std::string& refusal, const std::string& way) {
  if (!refusal.starts_with("mesh: ")) return "";  // the elements that do not fit, say
  try {
    const RepairedMesh repaired = repair(mesh);
    if (repaired.done.empty() || !repaired.left.empty() || !repaired.fault.empty()) return "";
    std::string text;
    for (const std::string& line : repaired.done) text += (text.empty() ? "" : ", ") + line;
    return "; " + way + " mends that: " + text;
  } catch (const Error&) {  // it is the refusal that counts
    return "";
  }
}

double volumeOf(const SurfaceMesh& mesh) {
  const Eigen::Vector3d& origin = mesh.vertices[mesh.triangles[0][0]];
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.vertices[a] - origin).dot((mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin)) / 6;
  return sum;
}

double anchorBandOf(const SurfaceMesh& mesh) {
  constexpr double kRounding = 1e-6;  // [size of the mesh]; floats hold 6e-8
  return std::max(CookOptions().anchorBand, kRounding * acrossOf(mesh));
}

}  // namespace rubble::demo
