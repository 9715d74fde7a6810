// Where the exposed faces of an element and a rigid body are in each other.
#pragma once

#include <utility>
#include <vector>

#include "edem/cell_faces.h"
#include "edem/collider.h"
#include "edem/contact.h"
#include "edem/mesh_side.h"
#include "edem/rigid_proxy.h"
#include "edem/round_touch.h"

namespace rubble::edem {

/// Names a corner of a rigid body, a tip or a point of a rim or an edge: what slides out of one cell into the
/// next.
struct CornerName {
  std::uint32_t part = 0;
  std::uint32_t corner = 0;  ///< 0: none
  std::uint32_t edge = 0;    ///< not 0: `corner` is a point of that edge
  bool operator==(const CornerName&) const = default;
};

/// A point of an element that is in a rigid body, or a point of a rigid body that is in an element. It acts
/// with the energy weight k_n depth^2 / 2. Axes of the element at rest, about its centre.
struct FaceHit {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();       ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< out of the rigid body: unit, shorter across a ridge
                                                      ///< of its distance
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();  ///< its weight falls by this as the element turns [-]
  Eigen::Vector3d sliding = Eigen::Vector3d::Zero();  ///< its weight falls by this as it moves [1/m]
  double depth = 0;                                   ///< > 0 [m]
  double weight = 0;                                  ///< stiffness over k_n
  double withheld = 0;                                ///< share of its force that is, by withhold()
  double yielded = 0;                                 ///< that it gave way by in this step [m]
  double nearer = 0;  ///< that it came deeper by in this step, at most all [m]
  double beyond = 0;  ///< of a corner: out of the cell by a covered face [m]
  CornerName corner;  ///< that of the rigid body's that is in the element
};

/// An element in the frame of a rigid body.
struct ElementPose {
  Eigen::Vector3d at;    ///< [m]
  Eigen::Matrix3d turn;  ///< from the axes of the element at rest
};

/// Corners may press cells that they are out of by less than this, over h: see FaceTouch::findCorners.
constexpr double kCornerSlack = 0.1;

/// Motion of an element's fragment relative to a rigid body, in the same axes and about the same point.
struct PartingMotion {
  Eigen::Vector3d centre, spin;
  double jolt;     ///< see withheld in fragment_motion.h [m/s]
  double resting;  ///< share of the force, see resting_loads.h
};

/// Finds the hits of elements at rigid bodies. Keeps its memory between calls.
class FaceTouch {
 public:
  /// Signed distance from `at`, the element's centre in the frame of the rigid body, to the nearest surface
  /// of its parts [m]. Notes which parts are within `reach`.
  double approach(const RigidProxy& proxy, const Eigen::Vector3d& at, double reach);
  /// The hits at those parts, but for their corners.
  ///   - Points of exposed faces in planes, boxes, hulls, cylinders and cones, and beyond meshes.
  ///   - Spheres and ends of capsules at the nearest point of the exposed faces.
  ///   - Edges of exposed faces across capsules, cylinders and cones.
  ///   - The element's core.
  /// `balls`: false where no sphere or corner is near.
  void find(const CellFaces& cells, const Exposure& exposure, std::uint32_t element, const ElementPose& pose,
            bool balls);
  /// The hits of corners and edges of boxes and hulls, tips of cones and rims alone, at the nearest point of
  /// the exposed faces. `beyond`: those beyond the cell's covered faces, too.
  void findCorners(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                   const ElementPose& pose, bool beyond);
  void add(const FaceHit& hit) { m_hits.push_back(hit); }
  /// Notes at every hit what it withholds of its force by the speed at which the fragment parts there, see
  /// withheld in fragment_motion.h.
  void withhold(const ContactLaw<double>& law, const PartingMotion& fragment);
  std::span<FaceHit> hits() { return m_hits; }
  /// Depth of the deepest of them and of the points that will press with the least turn, as those of a face
  /// that stands upright in a plane do; 0: none [m].
  double deepest() const { return m_deepest; }
  /// Where nothing touches: no point of the element can before it has come this far [m].
  double gap() const { return m_gap; }
  /// Takes change(hit) [m] off the depth of every hit; those that have none left are hits no more.
  template <class Change>
  void lift(Change&& change) {
    for (FaceHit& hit : m_hits) hit.depth -= change(hit);
    std::erase_if(m_hits, [](const FaceHit& hit) { return !(hit.depth > 0); });
  }
  /// visit(weight, normal, lever [m]) for every exposed point that looks at a part that approach() noted,
  /// and every edge on the side of a round one.
  template <class Visit>
  void visitFacing(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                   const ElementPose& pose, Visit&& visit) const {
    for (const Near& n : m_near) {
      const Eigen::Vector3d normal = pose.turn.transpose() * n.centre.normal;
      if (n.part->isRound()) {
        visitEdges(cells, exposure, element, [&](const CellFaces::Face&, std::uint32_t from, std::uint32_t) {
          const Eigen::Vector3d& at = cells.vertices[from];
          if (at.dot(normal) < 0) visit(kEdgeWeight, normal, Eigen::Vector3d(at.cross(normal)));
        });
      }
      if (!pressesPoints(*n.part)) continue;
      for (const ExposedPoint& p : exposure.of(cells, element)) {
        const double facing = -p.area.dot(normal);
        if (facing > 0) visit(facing / cells.unit, normal, Eigen::Vector3d(p.at.cross(normal)));
      }
    }
  }

 private:
  struct Near {
    const Collider* part;
    std::uint32_t index;     // of the part
    SurfacePoint centre;     // nearest to the element's centre, frame of the rigid body
    Eigen::Vector3d normal;  // of it, axes of the element
    std::uint32_t side;      // of a mesh: into m_sides
  };
  // Of a point in the frame of the rigid body.
  SurfacePoint nearestOf(const Near& near, const Eigen::Vector3d& point) const;
  Facing facingOf(const Near& near, const Eigen::Vector3d& point, const Eigen::Vector3d& area) const;

  SurfacePoint lookAtMesh(const Collider& part, const Eigen::Vector3d& at, double reach);

  // Notes the normals of the parts that are near in the element's axes.
  void turnNormals(const ElementPose& pose);
  // Forgets the convex parts that a plane parts from the cell by more than `slack` [m].
  void leaveOutApart(const CellFaces& cells, std::uint32_t element, double slack);

  void findPoints(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                  const ElementPose& pose);
  // In round_touch.cpp.
  void findEdges(const Near& near, const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                 const ElementPose& pose);
  void findRims(const Near& near, const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                const ElementPose& pose);
  void findRimCorners(const Rim& rim, double rounding, CornerName first, const CellFaces& cells,
                      const Exposure& exposure, std::uint32_t element);
  void findRimDeepest(const Rim& rim, double rounding, CornerName name, const CellFaces& cells,
                      const Exposure& exposure, std::uint32_t element);
  // The hit of a ball, axes of the element, but for its weight. It is in the cell that is out of it by less
  // than `slack` [m]. `sides`: see NearestFace.
  static bool ballHit(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                      const Eigen::Vector3d& centre, double radius, FaceHit& hit, double slack = 0,
                      std::span<const Eigen::Vector3d> sides = {});
  void findBalls(const Near& near, const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                 const ElementPose& pose);

  void findEdgePoints(const Near& near, const CellFaces& cells, const Exposure& exposure,
                      std::uint32_t element, const ElementPose& pose);
  bool isInAnother(const Near& near, const Eigen::Vector3d& at, double slack) const;

  std::vector<Near> m_near;
  std::vector<FaceHit> m_hits;
  double m_deepest = 0;
  double m_gap = 0;
  std::vector<MeshSide> m_sides;  // of the meshes in m_near
  std::uint32_t m_sideCount = 0;
  SurfacePoint m_nearest{0, Eigen::Vector3d::UnitY()};
};

/// Motion of an element relative to a rigid body, axes of the element at rest: its point x has the velocity
/// `centre` + `spin` x x.
struct ElementMotion {
  Eigen::Vector3d centre, spin;
  double gyration;  ///< of the element, inertia / mass [m^2]
};

/// The normal forces of all hits as one contact; axes of the element at rest, torques about its centre.
struct FacePress {
  Eigen::Vector3d elastic = Eigen::Vector3d::Zero(), damping = Eigen::Vector3d::Zero();              // [N]
  Eigen::Vector3d elasticTorque = Eigen::Vector3d::Zero(), dampingTorque = Eigen::Vector3d::Zero();  // [N m]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();      // centroid of the pressure [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, out of the rigid body
  double total = 0;                                  // force along it [N]
  double spread = 0;                                 // mean distance of the pressure from its centroid [m]
  double weight = 0;                                 // sum of the hits' weight times depth; 0: no contact
  double stiffness = 0;                              // of all hits, over k_n
  double full = 0;                                   // the same before any is withheld [N]
  double energy = 0;                                 // [J]
};

/// Each hit has its share of the law's dashpot, less at a lever, where the element is lighter, never pulls,
/// and withholds what was noted at it.
FacePress facePress(std::span<const FaceHit> hits, const ContactLaw<double>& law, const ElementMotion& motion,
                    const Steps& steps);

/// Sum of the weights that corners or the sphere of the body may have within `reach` of `at` (frame of the
/// rigid body) [-].
double ballWeights(const RigidProxy& proxy, const Eigen::Vector3d& at, double reach);
}  // namespace rubble::edem
