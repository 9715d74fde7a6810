#include "cook/delaunay.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

#include "rubble/asset.h"

namespace rubble::cooking {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel,
                                                           CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

}  // namespace

Tetrahedra delaunay(std::span<const Eigen::Vector3d> points) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> input;
  input.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    input.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()), i);
  const Triangulation triangulation(input.begin(), input.end());

  Tetrahedra result;
  if (triangulation.dimension() < 3) return result;
  std::uint32_t count = 0;
  for (const auto cell : triangulation.all_cell_handles())
    cell->info() = triangulation.is_infinite(cell) ? kNoElement : count++;
  result.points.reserve(count);
  result.neighbours.reserve(count);
  for (const auto cell : triangulation.finite_cell_handles()) {
    auto& corners = result.points.emplace_back();
    auto& neighbours = result.neighbours.emplace_back();
    for (int k = 0; k < 4; ++k) {
      corners[std::size_t(k)] = cell->vertex(k)->info();
      neighbours[std::size_t(k)] = cell->neighbor(k)->info();
    }
  }
  return result;
}

}  // namespace rubble::cooking
