#include "cook/cell_meshes.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "cook/scratch_map.h"
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
  CellMeshBuilder(const CheckedMesh& mesh, const SurfaceLook& look, RestrictedVoronoi diagram, Asset& asset)
      : m_mesh(mesh), m_look(look), m_diagram(std::move(diagram)), m_asset(asset) {
    asset.materialNames = look.materialNames();
  }

  // Takes what the diagram has of them alone: large, where the surface is of slivers.
  void buildVertices() {
    m_asset.vertices.reserve(m_diagram.vertices.size());
    for (std::size_t v = 0; v < m_diagram.vertices.size(); ++v)
      m_asset.vertices.push_back({m_diagram.vertices[v].cast<float>(), m_diagram.vertexSites[v]});
    m_diagram.vertexSites = std::vector<std::array<std::uint32_t, 4>>();  // `= {}` would keep the memory
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
      const auto [corner, isNew] = m_outerCorners.find(
          {vertex, bits(normal.x()), bits(normal.y()), bits(normal.z()), bits(uv.x()), bits(uv.y())});
      if (isNew) corner = newCorner(cell, vertex, normal, uv);
      m_polygonCorners.push_back(corner);
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
        const auto [corner, isNew] = m_capCorners.find({vertex});
        if (isNew) corner = newInnerCorner(cell, vertex, normal.cast<float>());
        triangle[k++] = corner;
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
    m_left.clear();  // one on a triangle, but for pieces that came from other cells
    for (const std::uint32_t p : polygons) m_left.emplace_back(m_diagram.surface.polygons[p].triangle, p);
    std::sort(m_left.begin(), m_left.end());
    m_isTaken.assign(m_left.size(), false);
    // From the largest on; of equal ones the first triangle's.
    std::vector<std::pair<double, std::size_t>> bySize;
    for (std::size_t at = 0; at < m_left.size(); ++at)
      bySize.emplace_back(polygonSize(m_left[at].second), at);
    std::stable_sort(bySize.begin(), bySize.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [size, at] : bySize)
      if (!m_isTaken[at]) addPatch(at);
  }

  void takeOn(std::uint32_t triangle, const Eigen::Vector3d& orientation) {
    if (m_mesh.normals[triangle].dot(orientation) < kPatchCosine) return;
    const auto first = std::lower_bound(m_left.begin(), m_left.end(), TrianglePolygon{triangle, 0});
    for (auto next = first; next != m_left.end() && next->first == triangle; ++next) {
      const auto at = std::size_t(next - m_left.begin());
      if (m_isTaken[at]) continue;
      m_isTaken[at] = true;
      m_queue.push_back(next->second);
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

  // Floods from one of the polygons that are left and takes what it reaches.
  void addPatch(std::size_t start) {
    const SurfacePieces& surface = m_diagram.surface;
    const Eigen::Vector3d orientation = m_mesh.normals[m_left[start].first];
    FaceSums sums;
    m_queue.assign(1, m_left[start].second);
    m_isTaken[start] = true;
    for (std::size_t at = 0; at < m_queue.size(); ++at) {
      const SurfacePolygon& polygon = surface.polygons[m_queue[at]];
      addSums(polygon, sums);
      for (std::uint32_t k = 0; k < polygon.count; ++k) {
        const std::uint8_t side = surface.sides[polygon.first + k];
        if (side != kCutEdge) takeOn(m_mesh.neighbours[polygon.triangle][side], orientation);
      }
      takeOn(polygon.triangle, orientation);
    }
    const double length = sums.area.norm();
    const Eigen::Vector3d normal = length > 0 ? Eigen::Vector3d(sums.area / length) : orientation;
    m_asset.faces.push_back(
        {kNoElement, float(sums.size), normal.cast<float>(), sums.centroid().cast<float>()});
  }

  const CheckedMesh& m_mesh;
  const SurfaceLook& m_look;
  RestrictedVoronoi m_diagram;
  Asset& m_asset;
  ScratchMap<6> m_outerCorners;         // by vertex and bits of normal and texture coordinates
  ScratchMap<1> m_capCorners;           // by vertex
  std::vector<TrianglePolygon> m_left;  // sorted; of the cell at hand
  std::vector<bool> m_isTaken;          // of them
  std::vector<std::uint32_t> m_polygonCorners, m_queue;
};

}  // namespace

void buildCellMeshes(const CheckedMesh& mesh, const SurfaceLook& look, RestrictedVoronoi diagram,
                     Asset& asset) {
  const std::size_t cells = diagram.cellCount();
  CellMeshBuilder builder(mesh, look, std::move(diagram), asset);
  builder.buildVertices();
  asset.cells.reserve(cells);
  for (std::uint32_t cell = 0; cell < cells; ++cell) builder.buildCell(cell);
}

}  // namespace rubble::cooking
