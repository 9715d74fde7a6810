// The faces of the cells as rigid bodies touch them, and which of them are exposed: the solid's own surface,
// and what broke.
//
// DEVIATION: the paper touches spheres. Between them small things pass, and a flat plate presses the few that
// stand out.
//
// An exposed face is its vertices: each carries a third of the vector areas of the triangles at it, and a
// vertex that several exposed faces meet in carries their sum. Two cells that share a face give it opposite
// areas, so that a break adds nothing to what presses both, and on a closed cell the force of a plane is that
// of the volume under it, a potential's.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "edem/types.h"
#include "rubble/asset.h"

namespace rubble::edem {

/// The faces of all cells of an asset; constant. Places are about the element's centre, asset axes.
struct CellFaces {
  static constexpr std::uint32_t kNoSpring = 0xffffffffu;

  /// A flat face.
  struct Face {
    std::uint32_t neighbour;      ///< element, or kNoElement: of the solid's surface
    std::uint32_t spring;         ///< to the neighbour, or kNoSpring
    std::uint32_t firstTriangle;  ///< into triangles
    std::uint32_t triangleCount;
    Eigen::Vector3d normal;  ///< unit, out of the cell
    double offset;           ///< normal . x of its plane [m]
  };

  std::vector<Eigen::Vector3d> vertices;                ///< grouped by cell, each place once [m]
  std::vector<std::uint32_t> firstVertex;               ///< (n + 1)
  std::vector<Face> faces;                              ///< grouped by cell
  std::vector<std::uint32_t> firstFace;                 ///< (n + 1)
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< into vertices
  std::vector<double> reach;                            ///< furthest vertex [m] (n)
  std::vector<double> core;  ///< radius of a sphere that is touched whatever is exposed [m] (n)
  double largestReach = 0;   ///< [m]
  double unit = 0;           ///< h^2: a flat face of this area has the stiffness k_n [m^2]

  std::span<const Face> of(std::uint32_t element) const {
    return std::span(faces).subspan(firstFace[element], firstFace[element + 1] - firstFace[element]);
  }
};

/// A vertex of exposed faces.
struct ExposedPoint {
  Eigen::Vector3d at;    ///< about the element's centre, asset axes [m]
  Eigen::Vector3d area;  ///< vector area, out of the cell [m^2]
};

/// Which faces are exposed, with what follows from it; state of a body.
struct Exposure {
  std::vector<std::uint8_t> faces;   ///< beside CellFaces::faces
  std::vector<std::uint8_t> torn;    ///< 1: the element has lost a spring (n)
  std::vector<ExposedPoint> points;  ///< those of element i begin at CellFaces::firstVertex[i]
  std::vector<std::uint32_t> count;  ///< of them (n)
  std::vector<double> area;          ///< sum of |area| [m^2] (n)
  std::vector<double> leverArea;     ///< sum of |area| |at|^2 [m^4] (n)
  std::vector<double> facing;        ///< no plane sees more of its faces than this [m^2] (n)

  std::span<const ExposedPoint> of(const CellFaces& cells, std::uint32_t element) const {
    return std::span(points).subspan(cells.firstVertex[element], count[element]);
  }
};

/// Sorts the triangles of the cells into flat faces and finds each face's spring.
CellFaces makeCellFaces(const Asset& asset);

/// The exposure of an unbroken body.
Exposure exposeOuter(const CellFaces& cells);

/// The spring of `first` and `second` broke: exposes the face between them. Faces of the two that never had a
/// spring, slivers beside an edge, are exposed with the first of their cell's or their neighbour's that
/// breaks.
void exposeBroken(const CellFaces& cells, std::span<const std::uint8_t> intact, std::uint32_t first,
                  std::uint32_t second, Exposure& exposure);

}  // namespace rubble::edem
