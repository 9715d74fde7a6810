#include "rubble/cook.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cook/balance.h"
#include "cook/cell_meshes.h"
#include "cook/cell_reach.h"
#include "cook/checked_mesh.h"
#include "cook/contradiction.h"
#include "cook/elements.h"
#include "cook/frame.h"
#include "cook/message.h"
#include "cook/parts.h"
#include "cook/polyhedron.h"
#include "cook/random.h"
#include "cook/restricted_voronoi.h"
#include "cook/site_pieces.h"
#include "cook/springs.h"
#include "cook/surface_check.h"
#include "cook/surface_look.h"
#include "rubble/limits.h"

namespace rubble {
namespace {

using namespace cooking;

// A cell that reaches farther than this from its element [h, the mean spacing] is a part of the solid that
// has too few elements. Packings of solids of one thickness reach 1.5 to 2.7; at the default fill h is 2.06
// radii.
constexpr double kReach = 3;
// Of centre [diagonal] and inertia [its norm]: the rest is rounding.
constexpr double kExactMoments = 1e-9;
constexpr double kJitter = 1e-6;  // of the Voronoi sites [r]; anything from 1e-9 to 1e-3 was measured to do

// Shares of a cook's time, for the progress bar.
constexpr double kProgressMeasuring = 0.02;
constexpr double kProgressPacking = 0.1;
constexpr double kCuttingShare = 0.2;  // of what is left
constexpr double kProgressMeshes = 0.9;

// `holds` is written such that NaN fails.
void require(bool holds, const char* option, const auto& value, const std::string& allowed) {
  if (!holds) throw Error(line(option, " is ", value, "; allowed: ", allowed));
}

void checkOptions(const CookOptions& options) {
  const bool isCountChosen = options.elements == 0 && options.radius > 0;
  require(isCountChosen || limits::kElements.hold(options.elements), "elements", options.elements,
          limits::kElements.text());
  require(limits::kElementRadius.hold(options.radius), "radius", options.radius,
          limits::kElementRadius.text() + " m, 0 to choose it by fill");
  require(limits::kFill.hold(options.fill), "fill", options.fill, limits::kFill.text());
  require(options.maxOverlap > 0 && options.maxOverlap <= kDeepestOverlap, "maxOverlap", options.maxOverlap,
          "above 0 to 0.2");
  require(options.maxIterations >= 1, "maxIterations", options.maxIterations, "1 and more");
  require(options.minFaceArea >= 0 && options.minFaceArea <= 1, "minFaceArea", options.minFaceArea, "0 to 1");
  require(options.anchorBand >= 0 && std::isfinite(options.anchorBand), "anchorBand", options.anchorBand,
          "metres, 0 and more");
  if (options.anchorDirection) {
    const double length = options.anchorDirection->norm();
    require(length > 0 && std::isfinite(length), "length of anchorDirection", length, "above 0 and finite");
  }
  for (const Eigen::AlignedBox3d& box : options.anchorRegions)
    if (!box.min().allFinite() || !box.max().allFinite() || box.isEmpty())
      throw Error(
          "anchorRegions has a box that is empty or not finite; allowed: two corners, the lesser first");
}

struct CutElements {
  Elements elements;
  RestrictedVoronoi diagram;
};

// Elements packed as densely as can be, or evenly where that leaves thin parts of the solid without.
CutElements packAndCut(const CheckedMesh& solid, const CookOptions& options, const ProgressFunction& report,
                       const LogFunction& log) {
  report(kProgressMeasuring, "measuring the walls");
  // Each packing, also one that starts again with smaller elements, gets half of what is left.
  double done = kProgressPacking;
  double last = 0;
  double least = done;
  Packer packer(solid, options, [&](double share) {
    if (share < last) least = done;
    last = share;
    done = std::max(done, least + share * (kProgressMeshes - least) / 2);
    report(done, "packing");
  });
  const auto foretold = packer.foretell();
  if (log)
    for (const auto& [level, text] : foretold) log(level, text);
  const auto cut = [&](Elements elements) {
    done += kCuttingShare * (kProgressMeshes - done);
    least = done;
    last = 0;
    report(done, "cutting cells");
    RestrictedVoronoi diagram =
        restrictedVoronoi(solid, elements.centres, kJitter * elements.radius, mix(options.seed), log);
    return CutElements{std::move(elements), std::move(diagram)};
  };
  const auto fillEmptyParts = [&](CutElements cells) {
    const bool isChanged =
        !cells.diagram.emptyParts.empty() && packer.fillEmptyParts(cells.diagram, cells.elements);
    return isChanged ? cut(std::move(cells.elements)) : std::move(cells);
  };
  // First what is likelier to do: in thin walls as dense as can be is long to find, and then leaves gaps.
  const bool isEvenFirst = !foretold.empty() && options.radius == 0;
  const auto fill = [&](bool isEven) { return cut(isEven ? packer.fillEvenly() : packer.fill()); };
  CutElements cells = fill(isEvenFirst);
  const double allowed = kReach * std::cbrt(solid.volume / double(cells.elements.centres.size()));
  const double reach = farthestCorner(cells.diagram);
  if (reach <= allowed) return fillEmptyParts(std::move(cells));

  CutElements others = fill(!isEvenFirst);
  if (farthestCorner(others.diagram) < reach) cells = std::move(others);
  cells = fillEmptyParts(std::move(cells));
  const double farthest = farthestCorner(cells.diagram);  // an element for each part may have mended it
  if (farthest > allowed)
    cells.elements.notes.emplace_back(
        LogLevel::Warning, line("too few elements for the thin parts of the mesh: a cell reaches ", farthest,
                                " m from its element, more than ", allowed, " m"));
  return cells;
}

// That the springs tie together what is one part of the solid, and nothing else.
void checkTies(const CheckedMesh& solid, const Asset& asset, const LogFunction& log) {
  const std::size_t parts = countParts(solid);
  const std::size_t tied = countTied(asset.elementCount(), asset.springs);
  if (tied == parts || !log) return;
  if (tied < parts && asset.elementCount() < parts) {
    log(LogLevel::Warning, line("the mesh has ", parts, " parts that do not touch and only ",
                                asset.elementCount(), " elements; ", parts, " and more would do"));
  } else if (tied < parts) {
    log(LogLevel::Warning, line("the mesh has ", parts,
                                " parts that do not touch, but springs tie some of "
                                "them together, to ",
                                tied, "; a wider gap between them would do"));
  } else {
    log(LogLevel::Warning,
        line("the mesh has ", parts, " parts that do not touch, but the springs tie the elements to ", tied,
             "; more elements may do"));
  }
}

std::vector<CellMoments> measureCells(const RestrictedVoronoi& diagram) {
  std::vector<CellMoments> cells;
  cells.reserve(diagram.cellCount());
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    PolyhedronIntegrals integrals(diagram.sites[cell]);
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      integrals.add(diagram.vertices[a], diagram.vertices[b], diagram.vertices[c]);
    });
    cells.push_back({integrals.volume(), integrals.centroid(), integrals.gyration(), integrals.thickness()});
  }
  return cells;
}

// What is to be tied, in the asset's frame.
AnchorWish anchorWish(const CookOptions& options, const Eigen::Vector3d& origin) {
  AnchorWish wish{options.anchorDirection, options.anchorBand, options.anchorRegions, origin};
  for (Eigen::AlignedBox3d& box : wish.regions) box.translate(-origin);
  return wish;
}

// Mass, centre and inertia of all elements are the solid's, or the log says by how much they are not.
void placeElements(const CheckedMesh& solid, const RestrictedVoronoi& diagram,
                   std::vector<Eigen::Vector3d> places, const LogFunction& log, Asset& asset) {
  const std::vector<CellMoments> cells = measureCells(diagram);
  for (const CellMoments& cell : cells) {
    asset.volumes.push_back(cell.volume);
    asset.gyrations.push_back(cell.gyration);
  }
  Balanced balanced = balance(solid, cells, std::move(places), asset.radius);
  asset.positions = std::move(balanced.places);
  if (log && std::max(balanced.centreError, balanced.inertiaError) > kExactMoments)
    log(LogLevel::Info,
        line("the solid is too thin for elements of this size to turn as it does: their moments of inertia "
             "together are off by ",
             100 * balanced.inertiaError, " %, their centre by ", 100 * balanced.centreError,
             " % of the solid's diagonal; more elements would do"));
}

}  // namespace

Asset cook(const SurfaceMesh& mesh, const CookOptions& options, const ProgressFunction& progress,
           const LogFunction& log) {
  double done = 0;
  const ProgressFunction report = [&progress, &done](double share, const char* stage) {
    done = std::max(done, share);
    if (progress) progress(done, stage);
  };
  checkOptions(options);
  report(0, "checking the mesh");
  CheckedMesh solid = checkMesh(mesh);
  checkLook(mesh);
  checkSurface(solid);
  const Eigen::Vector3d origin = frameOrigin(solid, options);
  if (!origin.isZero(0)) solid = checkMesh(moved(mesh, origin));

  auto [elements, diagram] = [&] {
    try {
      return packAndCut(solid, options, report, log);
    } catch (const NotCut&) {
      const std::string why = whyNotCut(solid, origin);
      if (why.empty()) throw;
      throw Error("mesh: cannot be cut into cells: " + why);
    }
  }();
  for (const auto& [level, text] : elements.notes)
    if (log) log(level, text);

  report(kProgressMeshes, "building meshes");
  Asset asset;
  asset.origin = origin;
  asset.radius = elements.radius;
  placeElements(solid, diagram, std::move(elements.centres), log, asset);
  const double spacing = asset.spacing();
  {
    const SitePieces pieces = findSitePieces(diagram);
    asset.springs = findSprings(diagram, pieces, options.minFaceArea * spacing * spacing);
    asset.anchors = findAnchors(solid, diagram, pieces, anchorWish(options, origin));
  }
  checkTies(solid, asset, log);
  buildCellMeshes(solid, SurfaceLook(mesh, solid), std::move(diagram), asset);
  asset.validate();
  report(1, "done");
  return asset;
}

}  // namespace rubble
