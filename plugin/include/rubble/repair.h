// A surface that is not closed, not oriented or passes through itself into one that can be cooked, as far as
// that can be known without asking. Needs rubble::cook (CGAL, GPL).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rubble/cook.h"

namespace rubble {

struct RepairOptions {
  /// Corners at open edges that are nearer to each other become one, and a corner so near to an open edge
  /// becomes a corner of it [diagonal of the mesh] (0 to 0.01). The default is a few roundings of a file of
  /// floats; more closes wider gaps and swallows finer detail.
  double weldDistance = 1e-6;
  /// Holes of more edges stay open (0: all). Time and memory grow with the square.
  std::size_t mostHoleEdges = 1000;
  /// Holes larger than this share of the area of their part of the surface stay open (0 to 1): what lacks
  /// more of its surface is rather a shell without thickness than a solid.
  double largestHole = 1.0 / 3;
  /// Closed parts that overlap or share a piece of face become one, exactly until corners are rounded to
  /// doubles. Without it, and where up to 200,000 triangles would not do, they are told of in
  /// RepairedMesh::left.
  bool unite = true;
};

struct RepairedMesh {
  SurfaceMesh mesh;
  /// What was done, in order: "welded 36 corners to 8". Empty: nothing was amiss, `mesh` is the one given.
  std::vector<std::string> done;
  /// What was found and is as it was: holes that are too large, places where it passes through itself.
  std::vector<std::string> left;
  /// What `cook` will refuse `mesh` for, in its words. Empty: nothing that its checks of the surface see.
  std::string fault;
};

/// Mends a surface, in this order:
/// - corners at the same place become one where edges are open, and edges get the corners that lie on them;
/// - triangles that stand twice are left out, as walls within the solid are, and those without area where
///   they are one too many at an edge;
/// - where parts touch along an edge, of four triangles there each two that have solid between them go
///   together;
/// - triangles turn as most others of their part do;
/// - holes are closed, within the limits of the options;
/// - closed parts that overlap or share a piece of face become one, those that only touch stay;
/// - parts turn outwards, and those wholly inside another inwards: they are cavities.
/// Triangles that are kept, also in pieces, keep normals (turned with them), texture coordinates and
/// material; those that close a hole have no normals, texture coordinates 0, 0 and the material beside them.
/// A part that passes through itself, a surface with one side and edges of three triangles are left as they
/// are. Some seconds for 400,000 triangles. Throws rubble::Error for what is no surface: nothing there,
/// numbers that are not finite, indices out of range; and for options out of range.
RepairedMesh repair(const SurfaceMesh& mesh, const RepairOptions& options = {});

}  // namespace rubble
