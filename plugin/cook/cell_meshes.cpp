#include "cook/cell_meshes.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <utility>

#include "rubble/triangle_look.h"

namespace rubble::cooking {
namespace {

constexpr double kPatchCosine =
    0.86602540378443865;  // of 30 degrees, between a polygon and its patch's first

// Area vector and first moment of some triangles.
struct FaceSums {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();    // [m^2]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [m^3]
  double size = 0;                                   // sum of the triangles' areas
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  // stands for the centroid of a face without area

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d share = (b - a).cross(c - a) / 2;
    area += share;
    size += share.norm();
    moment += share.norm() / 3 * (a + b + c);
    corner = a;
  }
  Eigen::Vector3d centroid() const { return size > 0 ? Eigen::Vector3d(moment / size) : corner; }
};

class CellMeshBuilder {
 public:
  CellMeshBuilder(const CheckedMesh& mesh, const SurfaceLook& look, const RestrictedVoronoi& diagram,
                  Asset& asset)
      : m_mesh(mesh), m_look(look), m_diagram(diagram), m_asset(asset) {
    asset.materialNames = look.materialNames();
  }

  void buildVertices() {
    for (std::size_t v = 0; v < m_diagram.vertices.size(); ++v)
      m_asset.vertices.push_back({m_diagram.vertices[v].cast<float>(), m_diagram.vertexSites[v]});
  }

  void buildCell(std::uint32_t cell) {
    Cell& result = m_asset.cells.emplace_back();
    result.firstTriangle = std::uint32_t(m_asset.triangles.size());
    result.firstFace = std::uint32_t(m_asset.faces.size());
    m_outerCorners.clear();
    for (const std::uint32_t p : m_diagram.polygonsOf.of(cell))
      addPolygon(cell, m_diagram.surface.polygons[p]);
    result.outerTriangles = std::uint32_t(m_asset.triangles.size()) - result.firstTriangle;
    addPatches(cell);
    for (const std::uint32_t c : m_diagram.capsOf.of(cell)) addCap(cell, m_diagram.caps.caps[c]);
    giveMaterial(m_asset.innerMaterial());
    result.innerTriangles =
        std::uint32_t(m_asset.triangles.size()) - result.firstTriangle - result.outerTriangles;
    result.faceCount = std::uint32_t(m_asset.faces.size()) - result.firstFace;
  }

 private:
  using CornerKey = std::array<std::uint32_t, 6>;  // vertex, bits of normal and texture coordinates
  using TrianglePolygon = std::pair<std::uint32_t, std::uint32_t>;

  std::uint32_t newCorner(std::uint32_t cell, std::uint32_t vertex, const Eigen::Vector3f& normal,
                          const Eigen::Vector2f& uv) {
    m_asset.corners.push_back({vertex, cell, normal});
    if (m_look.hasUvs()) m_asset.uvs.push_back(uv);
    return std::uint32_t(m_asset.corners.size() - 1);
  }

  std::uint32_t newInnerCorner(std::uint32_t cell, std::uint32_t vertex, const Eigen::Vector3f& normal) {
    const Eigen::Vector2f uv = m_look.hasUvs() ? boxUv(m_asset.vertices[vertex].position, normal)
                                               : Eigen::Vector2f(Eigen::Vector2f::Zero());
    return newCorner(cell, vertex, normal, uv);
  }

  // To the triangles added since the last call.
  void giveMaterial(std::uint32_t material) {
    if (m_look.hasMaterials()) m_asset.materials.resize(m_asset.triangles.size(), std::uint16_t(material));
  }

  void addPolygon(std::uint32_t cell, const SurfacePolygon& polygon) {
    m_polygonCorners.clear();
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
      const std::uint32_t vertex = m_diagram.surface.vertices[polygon.first + k];
      const Eigen::Vector3d& place = m_diagram.vertices[vertex];
      const Eigen::Vector3f normal = m_look.normal(polygon.triangle, place).cast<float>();
      const Eigen::Vector2f uv =
          m_look.hasUvs() ? m_look.uv(polygon.triangle, place) : Eigen::Vector2f(Eigen::Vector2f::Zero());
      // Neighbouring polygons of the cell share the corner where they agree on normal and texture.
      const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
      const CornerKey key = {vertex,           bits(normal.x()), bits(normal.y()),
                             bits(normal.z()), bits(uv.x()),     bits(uv.y())};
      const auto [entry, isNew] = m_outerCorners.try_emplace(key, 0);
      if (isNew) entry->second = newCorner(cell, vertex, normal, uv);
      m_polygonCorners.push_back(entry->second);
    }
    for (std::size_t k = 2; k < m_polygonCorners.size(); ++k)
      m_asset.triangles.push_back({m_polygonCorners[0], m_polygonCorners[k - 1], m_polygonCorners[k]});
    if (m_look.hasMaterials()) giveMaterial(m_look.material(polygon.triangle));
  }

  void addCap(std::uint32_t cell, const Cap& cap) {
    const std::uint32_t other = cap.first == cell ? cap.second : cap.first;
    const Eigen::Vector3d normal =
        cap.isFlat ? (m_diagram.sites[other] - m_diagram.sites[cell]).normalized() : bentNormal(cap, cell);
    m_capCorners.clear();
    FaceSums sums;
    m_diagram.visitCap(cap, cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; const std::uint32_t vertex : {a, b, c}) {
        const auto [entry, isNew] = m_capCorners.try_emplace(vertex, 0);
        if (isNew) entry->second = newInnerCorner(cell, vertex, normal.cast<float>());
        triangle[k++] = entry->second;
      }
      m_asset.triangles.push_back(triangle);
      sums.add(m_diagram.vertices[a], m_diagram.vertices[b], m_diagram.vertices[c]);
    });
    const double area = std::max(0.0, normal.dot(sums.area));
    m_asset.faces.push_back({other, float(area), normal.cast<float>(), sums.centroid().cast<float>()});
  }

  // Of the pieces' bisectors together, as they were cut.
  Eigen::Vector3d bentNormal(const Cap& cap, std::uint32_t cell) const {
    FaceSums sums;
    m_diagram.visitCap(cap, cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      sums.add(m_diagram.vertices[a], m_diagram.vertices[b], m_diagram.vertices[c]);
    });
    const double length = sums.area.norm();
    return length > 0 ? Eigen::Vector3d(sums.area / length) : Eigen::Vector3d::UnitZ();
  }

  // One face for each connected set of surface polygons that look nearly the same way.
  void addPatches(std::uint32_t cell) {
    const auto polygons = m_diagram.polygonsOf.of(cell);
    std::set<TrianglePolygon> left;  // one on a triangle, but for pieces that came from other cells
    for (const std::uint32_t p : polygons) left.emplace(m_diagram.surface.polygons[p].triangle, p);
    // From the largest on; of equal ones the first triangle's.
    std::vector<std::pair<double, std::uint32_t>> bySize;
    for (const auto& [triangle, p] : left) bySize.emplace_back(polygonSize(p), p);
    std::stable_sort(bySize.begin(), bySize.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [size, p] : bySize)
      if (left.contains({m_diagram.surface.polygons[p].triangle, p})) addPatch(p, left);
  }

  void takeOn(std::uint32_t triangle, const Eigen::Vector3d& orientation, std::set<TrianglePolygon>& left) {
    for (auto next = left.lower_bound({triangle, 0}); next != left.end() && next->first == triangle;) {
      if (m_mesh.normals[triangle].dot(orientation) < kPatchCosine) return;
      m_queue.push_back(next->second);
      next = left.erase(next);
    }
  }

  double polygonSize(std::uint32_t p) const {
    FaceSums sums;
    addSums(m_diagram.surface.polygons[p], sums);
    return sums.size;
  }

  void addSums(const SurfacePolygon& polygon, FaceSums& sums) const {
    m_diagram.visitPolygon(polygon, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      sums.add(m_diagram.vertices[a], m_diagram.vertices[b], m_diagram.vertices[c]);
    });
  }

  // Floods from the polygon `first` and takes what it reaches out of `left`.
  void addPatch(std::uint32_t first, std::set<TrianglePolygon>& left) {
    const SurfacePieces& surface = m_diagram.surface;
    const Eigen::Vector3d orientation = m_mesh.normals[surface.polygons[first].triangle];
    FaceSums sums;
    m_queue.assign(1, first);
    left.erase({surface.polygons[first].triangle, first});
    for (std::size_t at = 0; at < m_queue.size(); ++at) {
      const SurfacePolygon& polygon = surface.polygons[m_queue[at]];
      addSums(polygon, sums);
      for (std::uint32_t k = 0; k < polygon.count; ++k) {
        const std::uint32_t label = surface.labels[polygon.first + k];
        if (label < kSideLabel) continue;
        takeOn(m_mesh.neighbours[polygon.triangle][label - kSideLabel], orientation, left);
      }
      takeOn(polygon.triangle, orientation, left);
    }
    const double length = sums.area.norm();
    const Eigen::Vector3d normal = length > 0 ? Eigen::Vector3d(sums.area / length) : orientation;
    m_asset.faces.push_back(
        {kNoElement, float(sums.size), normal.cast<float>(), sums.centroid().cast<float>()});
  }

  const CheckedMesh& m_mesh;
  const SurfaceLook& m_look;
  const RestrictedVoronoi& m_diagram;
  Asset& m_asset;
  std::map<CornerKey, std::uint32_t> m_outerCorners;
  std::map<std::uint32_t, std::uint32_t> m_capCorners;  // vertex -> corner
  std::vector<std::uint32_t> m_polygonCorners, m_queue;
};

}  // namespace

void buildCellMeshes(const CheckedMesh& mesh, const SurfaceLook& look, const RestrictedVoronoi& diagram,
                     Asset& asset) {
  CellMeshBuilder builder(mesh, look, diagram, asset);
  builder.buildVertices();
  asset.cells.reserve(diagram.cellCount());
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) builder.buildCell(cell);
}

}  // namespace rubble::cooking
