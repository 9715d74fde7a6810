#include "demo/cooked_objects.h"

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <string>

#include "demo/keys.h"
#include "demo/primitives.h"
#include "demo/refuse_at.h"
#include "demo/solid.h"
#include "demo/substeps.h"
#include "rubble/cook.h"

namespace rubble::demo {
namespace {

// An object before the long work: its surface, or what was cooked before.
struct Uncooked {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const Asset> asset;
};

// Both are read from one file in one way.
bool readAlike(const SceneObject& a, const SceneObject& b) {
  const bool hasFile = !a.mesh.empty() || !a.asset.empty();
  return hasFile && a.mesh == b.mesh && a.asset == b.asset && a.scale == b.scale && a.repair == b.repair;
}

// The surface in the object's file, mended where the scene says so.
SurfaceMesh readObject(const SceneObject& object, const LogFunction& log) {
  SurfaceMesh mesh = readSolid(object.mesh, object.scale);
  const std::string advice = object.isScaleGiven ? "" : unitAdvice(mesh, "give it the key \"scale\": 0.001");
  if (log && !advice.empty()) log(LogLevel::Warning, object.mesh.string() + ": " + advice);
  if (!object.repair) return mesh;
  return repairSolid(mesh, [&](LogLevel level, const std::string& line) {
    if (log) log(level, object.mesh.string() + ": " + line);
  });
}

Uncooked uncookedObject(const SceneObject& object, const LogFunction& log) {
  if (!object.asset.empty()) return {{}, std::make_shared<const Asset>(load(object.asset))};
  return {std::make_shared<const SurfaceMesh>(object.mesh.empty() ? primitiveMesh(object)
                                                                  : readObject(object, log)),
          {}};
}

void requireAnchors(const SceneObject& object, const Uncooked& uncooked) {
  if (!object.anchorBody.empty() && uncooked.asset && uncooked.asset->anchors.empty())
    throw Error("anchor_body: is " + object.anchorBody + ", but " + object.asset.string() +
                " has no anchors: `rubble cook --anchor` makes them");
}

std::vector<Uncooked> uncookedObjects(const Scene& scene, const LogFunction& log) {
  std::vector<Uncooked> all;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    refuseAt(scene, i, [&] {
      std::size_t same = 0;
      while (same < i && !readAlike(scene.objects[same], scene.objects[i])) ++same;
      Uncooked object = same < i ? all[same] : uncookedObject(scene.objects[i], log);
      requireAnchors(scene.objects[i], object);
      if (object.asset) {
        requireSubsteps(scene, i, object.asset->volume(), object.asset->elementCount());
      } else {
        requireSubsteps(scene, i, volumeOf(*object.mesh), scene.objects[i].elements);
      }
      all.push_back(std::move(object));
    });
  }
  return all;
}

// The world's direction in the object's axes; the same bits where it is not turned.
std::optional<Eigen::Vector3d> ownAnchor(const SceneObject& object) {
  const double degrees = object.rotationDegrees.norm();
  if (!object.anchor || !(degrees > 0)) return object.anchor;
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, object.rotationDegrees / degrees);
  return Eigen::Vector3d(turn.inverse() * *object.anchor);
}

// None is an error, for what is to be tied would fall; else how many is said.
void tellAnchors(const SceneObject& object, const Asset& asset, const LogFunction& log) {
  if (!object.anchor && !object.anchorBox) return;
  if (asset.anchors.empty())
    throw Error("no flat side faces its anchor, " + shown(*object.anchor) +
                ": it must be the direction of one, in the world as the object stands in it");
  if (log)
    log(LogLevel::Info, std::to_string(asset.elementCount()) + " elements, " +
                            std::to_string(asset.anchors.size()) + " anchors tie them to " +
                            (object.anchorBody.empty() ? "the world" : object.anchorBody));
}

CookOptions cookOptions(const SceneObject& object, const SurfaceMesh& mesh, std::uint64_t seed) {
  CookOptions options;
  options.elements = object.elements;
  options.radius = object.radius;
  options.fill = object.fill;
  options.seed = seed;
  options.anchorDirection = ownAnchor(object);
  if (object.anchorBox) options.anchorRegions = {*object.anchorBox};
  if (!object.mesh.empty()) options.anchorBand = anchorBandOf(mesh);
  return options;
}

Asset cookMesh(const SceneObject& object, const SurfaceMesh& mesh, const CookOptions& options,
               const ProgressFunction& progress, const LogFunction& log) {
  try {
    return cook(
        mesh, options,
        [&](double share, const char* stage) {
          if (progress) progress(share, (std::string("cooking, ") + stage).c_str());
        },
        log);
  } catch (const Error& error) {
    const std::string refusal = error.what();
    if (object.mesh.empty()) throw;
    throw Error(object.mesh.string() + ": " + refusal +
                (object.repair ? "" : repairHint(mesh, refusal, "\"repair\": true")));
  }
}

// What is in the cache under that name, or cooked now and put there.
Asset keptOrCooked(const SceneObject& object, const SurfaceMesh& mesh, const CookOptions& options,
                   const std::string& name, AssetCache& cache, const ProgressFunction& progress,
                   const LogFunction& log) {
  if (std::optional<Asset> kept = cache.take(name, object.elements)) {
    if (progress) progress(1, ("taken from " + cache.file(name).string()).c_str());
    return std::move(*kept);
  }
  CookLog told;
  Asset asset = cookMesh(object, mesh, options, progress, [&](LogLevel level, const std::string& line) {
    told.push_back({level, line});
    if (log) log(level, line);
  });
  cache.keep(name, asset, told);
  return asset;
}

}  // namespace

Assets cookObjects(const Scene& scene, const ProgressFunction& progress, const LogFunction& log,
                   const CacheOptions& cacheOptions) {
  std::vector<Uncooked> uncooked = uncookedObjects(scene, log);
  AssetCache cache(cacheOptions, log);
  std::map<std::string, std::shared_ptr<const Asset>> cooked;
  Assets assets;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    refuseAt(scene, i, [&] {
      if (uncooked[i].asset) return assets.push_back(uncooked[i].asset);
      const SceneObject& object = scene.objects[i];
      const std::shared_ptr<const SurfaceMesh> mesh = std::move(uncooked[i].mesh);
      const CookOptions options = cookOptions(object, *mesh, scene.seed);
      const std::string name = cookName(*mesh, options);
      std::shared_ptr<const Asset>& asset = cooked[name];
      if (!asset)
        asset =
            std::make_shared<const Asset>(keptOrCooked(object, *mesh, options, name, cache, progress, log));
      tellAnchors(object, *asset, log);
      assets.push_back(asset);
    });
  }
  return assets;
}

}  // namespace rubble::demo
