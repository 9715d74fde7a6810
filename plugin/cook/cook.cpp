#include "rubble/cook.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "cook/cell_meshes.h"
#include "cook/checked_mesh.h"
#include "cook/hilbert.h"
#include "cook/packing.h"
#include "cook/polyhedron.h"
#include "cook/random.h"
#include "cook/restricted_voronoi.h"
#include "cook/signed_distance.h"
#include "cook/site_pieces.h"
#include "cook/springs.h"
#include "rubble/limits.h"

namespace rubble {
namespace {

using namespace cooking;

// Spheres that still overlap deeper than this [2 r] after the relaxation are too many for the solid. Nearly
// jammed but useful packings were measured at up to 0.11 (a wall 2.4 diameters thick, the ears of a bunny).
constexpr double kDeepestOverlap = 0.2;
// A chosen radius that does not fit shrinks by this much at a time, so often at most (down to 1.5 % of the
// first).
constexpr double kShrink = 0.9;
constexpr int kMostShrinks = 40;
constexpr double kJitter = 1e-6;  // of the Voronoi sites [r]; anything from 1e-9 to 1e-3 was measured to do

// Shares of a cook's time, for the progress bar.
constexpr double kProgressPacking = 0.1;
constexpr double kProgressCells = 0.7;
constexpr double kProgressMeshes = 0.9;

double ballVolume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

double radiusForFill(double volume, double fill, std::size_t count) {
  return std::cbrt(fill * volume / double(count) * 3 / (4 * std::numbers::pi));
}

template <class... Parts>
std::string line(const Parts&... parts) {
  std::ostringstream text;
  text << "cook: ";
  (text << ... << parts);
  return text.str();
}

// `holds` is written such that NaN fails.
void require(bool holds, const char* option, const auto& value, const std::string& allowed) {
  if (!holds) throw Error(line(option, " is ", value, "; allowed: ", allowed));
}

void checkOptions(const CookOptions& options) {
  require(limits::kElements.hold(options.elements), "elements", options.elements, limits::kElements.text());
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
}

struct PackedElements {
  double radius = 0;
  std::vector<Eigen::Vector3d> centres;
};

class Packer {
 public:
  Packer(const CheckedMesh& mesh, const CookOptions& options, const ProgressFunction& progress,
         const LogFunction& log)
      : m_mesh(mesh),
        m_options(options),
        m_progress(progress),
        m_log(log),
        m_distance(signedDistance(mesh)) {}

  PackedElements run() const {
    if (m_options.radius > 0) return packAsTold();
    double radius = radiusForFill(m_mesh.volume, m_options.fill, m_options.elements);
    for (int shrinks = 0;; ++shrinks, radius *= kShrink) {
      Packing packing = packWith(radius);
      // Not the next radius for which the thickest corners of a thin solid alone have room.
      const bool hasRoom = packing.centres.size() == m_options.elements;
      for (; !hasRoom && shrinks + 1 < kMostShrinks && kShrink * radius > packing.usualDepth; ++shrinks)
        radius *= kShrink;
      const bool isLast = shrinks == kMostShrinks;
      if (!isLast && !fits(packing)) continue;
      requireFit(packing, radius);
      if (shrinks > 0) warnOfShrink(radius);
      return finish(std::move(packing), radius);
    }
  }

 private:
  PackedElements packAsTold() const {
    const double radius = m_options.radius;
    const double fill = double(m_options.elements) * ballVolume(radius) / m_mesh.volume;
    if (fill > 1) {
      throw Error(line(m_options.elements, " elements of radius ", radius, " m fill ", fill,
                       " times the mesh's volume of ", m_mesh.volume, " m^3; ", whatFits(radius)));
    }
    Packing packing = packWith(radius);
    requireFit(packing, radius);
    return finish(std::move(packing), radius);
  }

  Packing packWith(double radius) const {
    m_distance->fitTo(radius);
    const PackingDef def{m_options.elements, radius, mix(m_options.seed), m_options.maxOverlap,
                         m_options.maxIterations};
    return pack(*m_distance, m_mesh.bounds, def, [this](double share) {
      m_progress(kProgressPacking + share * (kProgressCells - kProgressPacking), "packing");
    });
  }

  bool fits(const Packing& packing) const {
    return packing.centres.size() == m_options.elements && packing.deepestOverlap <= kDeepestOverlap;
  }

  void requireFit(const Packing& packing, double radius) const {
    if (packing.centres.size() < m_options.elements)
      throw Error(line("no sphere of radius ", radius, " m fits into the mesh: the deepest place found is ",
                       packing.deepestPlace, " m from its surface"));
    if (!fits(packing))
      throw Error(line(m_options.elements, " elements of radius ", radius,
                       " m do not fit: they overlap by up to ", 100 * packing.deepestOverlap,
                       " % of their diameter; ", whatFits(radius)));
  }

  std::string whatFits(double radius) const {
    const double count = std::floor(m_options.fill * m_mesh.volume / ballVolume(radius));
    std::ostringstream text;
    text << "about " << count << " elements of this radius fit, or a radius of about "
         << radiusForFill(m_mesh.volume, m_options.fill, m_options.elements) << " m";
    return text.str();
  }

  void warnOfShrink(double radius) const {
    if (!m_log) return;
    const double fill = double(m_options.elements) * ballVolume(radius) / m_mesh.volume;
    m_log(LogLevel::Warning, line("elements that fill ", m_options.fill, " of the mesh do not fit; radius ",
                                  radius, " m taken, which fills ", fill));
  }

  PackedElements finish(Packing packing, double radius) const {
    if (m_log) {
      m_log(LogLevel::Info, line("packed ", packing.centres.size(), " elements of radius ", radius, " m in ",
                                 packing.iterations, " iterations, deepest overlap ",
                                 100 * packing.deepestOverlap, " % of the diameter"));
      constexpr double kNoticed = 0.01;  // [r]
      if (packing.deepestProtrusion > kNoticed * radius)
        m_log(LogLevel::Warning,
              line("an element protrudes by ", packing.deepestProtrusion, " m from the mesh"));
    }
    PackedElements elements{radius, {}};
    for (const std::uint32_t i : hilbertOrder(packing.centres))
      elements.centres.push_back(packing.centres[i]);
    return elements;
  }

  const CheckedMesh& m_mesh;
  const CookOptions& m_options;
  const ProgressFunction& m_progress;
  const LogFunction& m_log;
  const std::unique_ptr<SignedDistance> m_distance;
};

void measureCells(const RestrictedVoronoi& diagram, Asset& asset) {
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    PolyhedronIntegrals integrals(diagram.sites[cell]);
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      integrals.add(diagram.vertices[a], diagram.vertices[b], diagram.vertices[c]);
    });
    asset.volumes.push_back(integrals.volume());
    asset.gyrations.push_back(integrals.gyration());
  }
}

}  // namespace

Asset cook(const SurfaceMesh& mesh, const CookOptions& options, const ProgressFunction& progress,
           const LogFunction& log) {
  double done = 0;
  const ProgressFunction report = [&progress, &done](double share, const char* stage) {
    done = std::max(done, share);  // packing starts again where it has to shrink the elements
    if (progress) progress(done, stage);
  };
  checkOptions(options);
  report(0, "checking the mesh");
  const CheckedMesh solid = checkMesh(mesh);

  report(kProgressPacking, "packing");
  PackedElements elements = Packer(solid, options, report, log).run();

  report(kProgressCells, "cutting cells");
  const RestrictedVoronoi diagram =
      restrictedVoronoi(solid, elements.centres, kJitter * elements.radius, mix(options.seed), log);
  const SitePieces pieces = findSitePieces(diagram);

  report(kProgressMeshes, "building meshes");
  Asset asset;
  asset.radius = elements.radius;
  asset.positions = std::move(elements.centres);
  measureCells(diagram, asset);
  const double spacing = asset.spacing();
  asset.springs = findSprings(diagram, pieces, options.minFaceArea * spacing * spacing);
  if (options.anchorDirection)
    asset.anchors = findAnchors(solid, diagram, pieces, *options.anchorDirection, options.anchorBand);
  buildCellMeshes(solid, diagram, asset);
  asset.validate();
  report(1, "done");
  return asset;
}

}  // namespace rubble
