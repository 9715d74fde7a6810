#include "cook/shell_tree.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include "cook/soup_mesh.h"

namespace rubble::cooking {

struct ShellTree::Trees {
  using Tree =
      CGAL::AABB_tree<CGAL::AABB_traits<MeshKernel, CGAL::AABB_face_graph_triangle_primitive<TriangleMesh>>>;

  Trees(const Soup& soup, const Shell& shell)
      : mesh(triangleMeshOf(soup, shell.triangles)),
        tree(mesh.faces().begin(), mesh.faces().end(), mesh),
        sides(tree) {}

  TriangleMesh mesh;
  Tree tree;
  CGAL::Side_of_triangle_mesh<TriangleMesh, MeshKernel> sides;
};

ShellTree::ShellTree(const Soup& soup, const Shell& shell) : m_trees(std::make_unique<Trees>(soup, shell)) {}

ShellTree::~ShellTree() = default;

ShellSide ShellTree::sideOf(const Eigen::Vector3d& place) const {
  const CGAL::Bounded_side side = m_trees->sides(meshPoint(place));
  if (side == CGAL::ON_BOUNDARY) return ShellSide::On;
  return side == CGAL::ON_BOUNDED_SIDE ? ShellSide::Within : ShellSide::Outside;
}

bool ShellTree::isNear(const Eigen::Vector3d& place, double reach) const {
  const Eigen::Vector3d out = Eigen::Vector3d::Constant(reach);
  return m_trees->tree.do_intersect(MeshKernel::Iso_cuboid_3(meshPoint(place - out), meshPoint(place + out)));
}

bool liesWithin(const Soup& soup, const Shell& inner, const ShellTree& outer) {
  for (const std::uint32_t t : inner.triangles)
    for (const std::uint32_t v : soup.triangles[t])
      if (const ShellSide side = outer.sideOf(soup.vertices[v]); side != ShellSide::On)
        return side == ShellSide::Within;
  return false;
}

}  // namespace rubble::cooking
