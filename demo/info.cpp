#include "demo/info.h"

#include <malloc.h>

#include <cmath>
#include <iomanip>
#include <sstream>

#include "demo/console.h"
#include "demo/dust_setup.h"
#include "demo/input_error.h"
#include "demo/keys.h"
#include "demo/window/egl_context.h"
#include "demo/world.h"

namespace rubble::demo {
namespace {

// Memory in use by the program [MB], as its allocator counts it.
double memoryInUse() {
  const struct mallinfo2 info = mallinfo2();
  return double(info.uordblks + info.hblkhd) / 1e6;
}

std::ostream& row(std::ostream& out, const std::string& name) {
  constexpr int kNameWidth = 22;  // of the longest name
  return out << "  " << std::left << std::setw(kNameWidth) << name;
}

// How many triangles have each material; the last one is that of inner faces.
std::vector<std::size_t> trianglesOf(const Asset& asset) {
  std::vector<std::size_t> counts(asset.innerMaterial() + 1);
  for (const std::uint16_t material : asset.materials) ++counts[material];
  if (!asset.materials.empty()) return counts;
  for (const Cell& cell : asset.cells) {
    counts.front() += cell.outerTriangles;
    counts.back() += cell.innerTriangles;
  }
  return counts;
}

// A line each: the mesh's, which may have no name, then the inner faces.
void describeMaterials(const Asset& asset, std::ostream& out) {
  const std::vector<std::size_t> counts = trianglesOf(asset);
  for (std::size_t m = 0; m < counts.size(); ++m) {
    const bool isInner = m + 1 == counts.size();
    row(out, m == 0 ? "materials" : "")
        << m << ", "
        << (isInner                       ? "inner faces"
            : asset.materialNames.empty() ? "the mesh, without a name"
                                          : asset.materialNames[m])
        << ": " << counts[m] << (counts[m] == 1 ? " triangle\n" : " triangles\n");
  }
}

void describe(const Asset& asset, std::ostream& out) {
  row(out, "elements") << asset.elementCount() << ", radius " << asset.radius << " m\n";
  row(out, "origin") << shown(asset.origin) << " m in the mesh's coordinates\n";
  row(out, "springs") << asset.springs.size() << " and " << asset.anchors.size() << " anchors\n";
  row(out, "made of") << (asset.preset.empty() ? "no material preset" : asset.preset) << '\n';
  row(out, "volume") << asset.volume() << " m^3, spacing " << asset.spacing() << " m\n";
  row(out, "cell meshes") << asset.triangles.size() << " triangles, "
                          << (asset.uvs.empty() ? "no" : "the mesh's") << " texture coordinates\n";
  describeMaterials(asset, out);
}

bool needsGl(const Scene& scene) {
  return scene.dust && scene.dust->backend == DustBackend::Gl;
}

std::string rendererName() {
  try {
    return EglContext().renderer();
  } catch (const Error& error) {
    return std::string("nothing here: ") + error.what();
  }
}

void describeNeeds(const Scene& scene, std::ostream& out) {
  row(out, "OpenGL") << (needsGl(scene) ? "needed: dust.backend is gl\n"
                                        : "only for pictures; none with --no-render\n");
  row(out, "drawn by") << rendererName() << '\n';
  if (scene.dust) {
    // Measured on the CPU whatever the scene asks for; the arrays are the same on a graphics card.
    Scene onCpu = scene;
    onCpu.dust->backend = DustBackend::Cpu;
    const double before = memoryInUse();
    const auto grid = makeDust(onCpu, Renderer3D::None, 1);
    row(out, "dust") << scene.dust->resolution << "^3 cells, " << memoryInUse() - before
                     << " MB on the CPU\n";
  } else {
    row(out, "dust") << "none: no grid, no thread\n";
  }
  if (scene.debris) {
    row(out, "debris") << "up to " << scene.debris->budget << " pieces\n";
  } else {
    row(out, "debris") << "none\n";
  }
}

}  // namespace

void describeScene(const Scene& scene, const CacheOptions& cache, std::ostream& stream) {
  std::ostringstream out;  // told when all is known: an error leaves no half table
  const double before = memoryInUse();
  const Assets assets = cookWithProgress(scene, cache);
  const double cooked = memoryInUse();
  World world(scene, assets, consoleLog());
  const double built = memoryInUse();

  out << scene.file << '\n';
  for (std::size_t i = 0; i < assets.size(); ++i) {
    out << "object " << i << ", " << scene.objects[i].material.name << '\n';
    describe(*assets[i], out);
    row(out, "mass") << world.destruction().bodies()[i]->elementMass() << " kg\n";
  }
  out << "the run\n";
  const double frame = 1 / scene.fps;
  const double substep = world.destruction().stableSubstep();
  row(out, "bodies of Bullet") << scene.impactors.size() << " moving, " << scene.statics.size()
                               << " static\n";
  row(out, "frames") << scene.frames << " of " << frame << " s, Bullet at " << scene.bulletRate << " Hz\n";
  if (!assets.empty()) {
    row(out, "stable substep") << substep << " s, about " << std::ceil(frame / substep)
                               << " substeps a frame of " << scene.maxSubstepsPerFrame << " allowed\n";
  }
  row(out, "memory") << "assets " << cooked - before << " MB, world " << built - cooked << " MB\n";
  describeNeeds(scene, out);
  stream << out.str();
}

bool isAssetFile(const std::string& nameOrPath) {
  return std::filesystem::path(nameOrPath).extension() == ".rubble-asset";
}

void describeAsset(const std::filesystem::path& file, std::ostream& out) {
  try {
    const Asset asset = load(file);
    out << file.string() << '\n';
    describe(asset, out);
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

}  // namespace rubble::demo
