#include "bullet/cell_shape.h"

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

CellShape::CellShape(const edem::CellFaces* cells, std::uint32_t element, double radius)
    : m_cells(cells), m_element(element) {
  m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;  // Bullet's shortcuts by type must ask the functions below
  setMargin(cells ? 0 : btScalar(radius));
}

double CellShape::reach() const {
  return m_cells ? m_cells->reach[m_element] : double(getMargin());
}

btVector3 CellShape::localGetSupportingVertexWithoutMargin(const btVector3& direction) const {
  if (!m_cells) return {0, 0, 0};  // the margin is its radius
  const Eigen::Vector3d along = toEigen(direction);
  const std::uint32_t begin = m_cells->firstVertex[m_element], end = m_cells->firstVertex[m_element + 1];
  std::uint32_t furthest = begin;
  double most = m_cells->vertices[begin].dot(along);
  for (std::uint32_t v = begin + 1; v < end; ++v) {
    const double far = m_cells->vertices[v].dot(along);
    if (!(far > most)) continue;
    most = far;
    furthest = v;
  }
  return toBullet(m_cells->vertices[furthest]);
}

void CellShape::batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* out,
                                                                  int count) const {
  for (int i = 0; i < count; ++i) out[i] = localGetSupportingVertexWithoutMargin(directions[i]);
}

// Of its box, as Bullet's own convex shapes have it.
void CellShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  btVector3 low, high;
  getAabb(btTransform::getIdentity(), low, high);
  const btVector3 square = (high - low) * (high - low);
  inertia = mass / btScalar(12) *
            btVector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y());
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
