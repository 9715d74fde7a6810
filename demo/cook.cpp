#include "demo/cook.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <string>

#include "base/stopwatch.h"
#include "demo/console.h"
#include "demo/info.h"
#include "demo/input_error.h"
#include "demo/output_file.h"
#include "demo/progress.h"
#include "demo/solid.h"
#include "rubble/asset.h"
#include "rubble/limits.h"
#include "rubble/machine_error.h"
#include "rubble/material.h"

namespace rubble::demo {
namespace {

// As many digits as a person reads.
std::string numberText(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

void checkNumbers(const CookFileOptions& options) {
  const auto check = [](const char* option, double value, const Limits& limits) {
    if (!limits.hold(value))
      throw InputError(option, numberText(value), "is not allowed, must be " + limits.text());
  };
  if (options.elements) check("--elements", double(*options.elements), limits::kElements);
  if (options.radius) check("--radius", *options.radius, {1e-6, limits::kElementRadius.high});
  if (options.scale) check("--scale", *options.scale, kMeshScale);
}

void checkMaterial(const CookFileOptions& options) {
  if (!options.material) return;
  try {
    material(*options.material);
  } catch (const Error& error) {
    throw InputError("--" + std::string(error.what()));
  }
}

void checkTarget(const CookFileOptions& options) {
  const std::string name = options.asset.string();
  checkFile("--output", options.asset, {});
  std::error_code error;
  const auto status = std::filesystem::status(options.asset, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError("--output", name, "is a pipe, a socket or a device, must be a file, old or new");
  if (!isAssetFile(name))
    throw InputError("--output", name, "does not end in .rubble-asset, must do so to be known again");
  if (sameFile(options.mesh, options.asset))
    throw InputError("--output", name, "is the mesh itself, must be another file");
}

CookOptions cookOptions(const CookFileOptions& given, const SurfaceMesh& mesh) {
  CookOptions options;
  options.seed = given.seed;
  options.anchorDirection = given.anchor;
  options.anchorRegions = given.anchorBoxes;
  options.anchorBand = anchorBandOf(mesh);
  if (given.radius) options.radius = *given.radius;
  if (given.elements) {
    options.elements = *given.elements;
  } else if (given.radius) {
    options.elements = 0;  // as many as fill the solid or fit
  }
  return options;
}

void adviseOnUnit(const CookFileOptions& given, const SurfaceMesh& mesh) {
  const std::string advice = unitAdvice(mesh, "cook it with --scale 0.001");
  if (!advice.empty()) consoleLog()(LogLevel::Warning, given.mesh.string() + ": " + advice);
}

SurfaceMesh meshOf(const CookFileOptions& given) {
  try {
    const SurfaceMesh mesh = readSolid(given.mesh, given.scale.value_or(1));
    if (!given.scale) adviseOnUnit(given, mesh);
    if (!given.repair) return mesh;
    return repairSolid(mesh, [&given](LogLevel, const std::string& line) {
      std::cerr << "rubble: " << given.mesh.string() << ": " << line << '\n';
    });
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

Asset cookSolid(const SurfaceMesh& mesh, const CookFileOptions& given) {
  const CookOptions options = cookOptions(given, mesh);
  try {
    Progress progress(given.mesh.stem().string());
    return cook(
        mesh, options,
        [&](double share, const char* stage) { progress.show(share, std::string("cooking, ") + stage); },
        consoleLog());
  } catch (const Error& error) {
    const std::string refusal = error.what();
    throw InputError(given.mesh.string(), "",
                     refusal + (given.repair ? "" : repairHint(mesh, refusal, "--repair")));
  }
}

}  // namespace

void cookFile(const CookFileOptions& options, std::ostream& out) {
  base::Stopwatch clock;
  checkNumbers(options);
  checkMaterial(options);
  checkTarget(options);
  Asset asset = cookSolid(meshOf(options), options);
  asset.preset = options.material.value_or("");
  if (options.anchor && asset.anchors.empty())
    throw InputError("--anchor", options.mesh.string(),
                     "has no flat side that faces this way, must be the direction of one");
  try {
    save(asset, options.asset);
  } catch (const Error& error) {
    throw MachineError(error.what());  // the name was looked at before
  }
  out << options.asset.string() << ": " << asset.elementCount() << " elements, " << asset.springs.size()
      << " springs, " << asset.anchors.size() << " anchors, radius " << asset.radius << " m, volume "
      << asset.volume() << " m^3, " << asset.triangles.size() << " triangles, in " << clock.lap() / 1000
      << " s\n";
}

}  // namespace rubble::demo
