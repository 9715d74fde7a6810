// The rigid surfaces that elements touch: plane, sphere, box, convex hull, capsule, cylinder, cone, with
// their signed distance in closed form; triangle meshes.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "edem/triangle_mesh.h"
#include "edem/types.h"

namespace rubble::edem {

/// A convex polyhedron as its faces.
struct Hull {
  struct Face {
    Eigen::Vector3d normal;                 ///< outward, unit
    double offset;                          ///< normal . x of the plane [m]
    std::vector<Eigen::Vector3d> vertices;  ///< counter-clockwise seen from outside [m]
  };
  /// A sharp edge between two faces.
  struct Edge {
    Eigen::Vector3d from, way;  ///< its ends are from and from + way [m]
    double sharpness;           ///< 1 - cos of the angle between the normals: 1 of a right edge, 2 of a blade
    std::array<Eigen::Vector3d, 2> sides;  ///< the normals
  };
  std::vector<Face> faces;
  std::vector<Eigen::Vector3d> corners;  ///< each vertex once; written by listCorners [m]
  std::vector<Edge> edges;               ///< but for those of faces in one plane; by listCorners
  double cornerWeight = 0;               ///< stiffness of one over that of a contact; by listCorners
};

/// Fills a hull's corners and edges from its faces.
void listCorners(Hull& hull);

/// A surface in its own frame, rounded by `rounding`.
struct Collider {
  enum class Kind : std::uint8_t { Plane, Sphere, Box, Hull, Capsule, Cylinder, Cone, Mesh };
  Kind kind = Kind::Sphere;
  /// Half extents of a box; x is a sphere's radius; a plane's normal. Solids of revolution stand along y:
  /// x is the radius, y half the length of a capsule's segment or half the height of the others, a cone's
  /// apex up [m].
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
  double offset = 0;    ///< a plane's: normal . x [m]
  double rounding = 0;  ///< added all round, Bullet's collision margin [m]
  std::shared_ptr<const Hull> hull;
  std::shared_ptr<const TriangleMesh> mesh;
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();  ///< in the frame of the rigid body

  /// Capsule, cylinder or cone.
  bool isRound() const { return kind == Kind::Capsule || kind == Kind::Cylinder || kind == Kind::Cone; }
  Eigen::AlignedBox3d bounds() const;  ///< in the frame of the rigid body; a plane's is infinite
  double thickness() const;  ///< its least width; infinite where it has no other side: plane, mesh [m]
};

/// Nearest point of a surface.
struct SurfacePoint {
  double distance;         ///< signed: negative inside; a mesh has no inside [m]
  Eigen::Vector3d normal;  ///< unit, out of the surface
};

/// Signed distance of `point` (in the frame of the rigid body) and the outward normal there. What is further
/// than `reach` may be told as infinitely far, which is faster for meshes.
SurfacePoint nearest(const Collider& collider, const Eigen::Vector3d& point,
                     double reach = std::numeric_limits<double>::infinity());

}  // namespace rubble::edem
