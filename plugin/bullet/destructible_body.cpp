#include "rubble/destructible_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <optional>
#include <typeinfo>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"
#include "edem/cell_faces.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

// What has hit a cell is no further from its centre than this, in the cell's reach.
constexpr double kNear = 1.5;

// From the asset's frame to the world's, of a whole body whose elements are where the asset has them. The
// solver's are placed when it needs them; nothing is written here, so that threads may ask at once.
std::optional<Eigen::Isometry3d> placeOfWhole(const DestructibleBody& body) {
  const DestructibleBody::Impl& own = implOf(body);
  if (!body.isWhole() || own.held) return std::nullopt;
  const Eigen::Isometry3d place = bullet::toEigen(body.getWorldTransform()) * own.whole.frame.inverse();
  if (!place.matrix().allFinite()) return std::nullopt;
  return place;
}

// How far a place, about the centre and in the asset's axes, is out of a cell, by all faces that it is out of
// [m]: Bullet's rays end up to 1 cm before a shape. Less than 0 within. Planes are those of all triangles of
// a face, for its own is that of its first one, which may be a sliver.
double outOf(const edem::CellFaces& cells, std::uint32_t element, const Eigen::Vector3d& place) {
  double out2 = 0, furthest = -std::numeric_limits<double>::infinity();
  for (const edem::CellFaces::Face& face : cells.of(element)) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    double sizes = 0;
    for (std::uint32_t t = 0; t < face.triangleCount; ++t) {
      const auto& corners = cells.triangles[face.firstTriangle + t];
      const Eigen::Vector3d &a = cells.vertices[corners[0]], &b = cells.vertices[corners[1]],
                            &c = cells.vertices[corners[2]];
      const Eigen::Vector3d twice = (b - a).cross(c - a);
      area += twice;
      moment += twice.norm() / 3 * (a + b + c);
      sizes += twice.norm();
    }
    if (!(sizes > 0)) continue;
    const double out = area.normalized().dot(place - moment / sizes);
    out2 += std::max(0.0, out) * std::max(0.0, out);
    furthest = std::max(furthest, out);
  }
  return furthest > 0 ? std::sqrt(out2) : furthest;
}

// Elsewhere a page each would be read in every tick: bodies are made between large arrays. Never ends, for
// worlds may outlive what is static. A sanitizer is to see each body's own end.
std::pmr::memory_resource& bodyMemory() {
#ifdef __SANITIZE_ADDRESS__
  return *std::pmr::new_delete_resource();
#else
  static auto* const pool = new std::pmr::synchronized_pool_resource({0, 4096});
  return *pool;
#endif
}
constexpr std::size_t kCacheLine = 64;

}  // namespace

void* DestructibleBody::operator new(std::size_t size) {
  return bodyMemory().allocate(size, kCacheLine);
}
void DestructibleBody::operator delete(void* memory, std::size_t size) {
  bodyMemory().deallocate(memory, size, kCacheLine);
}
void* DestructibleBody::Impl::operator new(std::size_t size) {
  return bodyMemory().allocate(size, kCacheLine);
}
void DestructibleBody::Impl::operator delete(void* memory, std::size_t size) {
  bodyMemory().deallocate(memory, size, kCacheLine);
}

DestructibleBody::DestructibleBody(const btRigidBodyConstructionInfo& info, std::unique_ptr<Impl> impl)
    : btRigidBody(info), m_impl(std::move(impl)) {
  setIgnoreCollisionCheck(this, true);  // while there is one that it ignores, Bullet asks it
}

bool DestructibleBody::checkCollideWithOverride(const btCollisionObject* other) const {
  // In its list of whom it ignores it stands itself, and the list in memory that nothing else needs.
  const bool may = m_objectsWithoutCollisionCheck.size() == 1 || btRigidBody::checkCollideWithOverride(other);
  if (may && m_impl->world) m_impl->world->meet(const_cast<DestructibleBody&>(*this), *other);
  return may;
}

DestructibleBody::~DestructibleBody() {
  if (m_impl->world) m_impl->world->forget(*this);
}

const DestructibleBody* DestructibleBody::upcast(const btCollisionObject* object) {
  // By its class, which nothing derives from: Bullet's marks, its user indices, are the application's.
  if (!object || typeid(*object) != typeid(DestructibleBody)) return nullptr;
  return static_cast<const DestructibleBody*>(object);
}
DestructibleBody* DestructibleBody::upcast(btCollisionObject* object) {
  return const_cast<DestructibleBody*>(upcast(static_cast<const btCollisionObject*>(object)));
}

std::uint32_t DestructibleBody::id() const {
  return m_impl->id;
}
std::uint32_t DestructibleBody::source() const {
  return m_impl->source;
}
const std::shared_ptr<const Asset>& DestructibleBody::asset() const {
  return m_impl->asset;
}
const Material& DestructibleBody::material() const {
  return m_impl->material;
}
const Model& DestructibleBody::model() const {
  return m_impl->model;
}

void DestructibleBody::poses(std::span<ElementPose> out) const {
  const edem::Solver& solver = *m_impl->world->solver;
  const edem::BodyView view = solver.view(m_impl->id);
  if (const auto place = placeOfWhole(*this)) {
    const Eigen::Vector4f turn = Eigen::Quaterniond(place->linear()).normalized().coeffs().cast<float>();
    const std::vector<Eigen::Vector3d>& positions = m_impl->asset->positions;
    for (std::size_t i = 0; i < out.size() && i < positions.size(); ++i)
      out[i] = {(*place * positions[i]).cast<float>(), 1.0f, turn};
    return;
  }
  for (std::size_t i = 0; i < out.size() && i < view.alive.size(); ++i) {
    out[i].position = solver.position(m_impl->id, i).cast<float>();
    out[i].alive = view.alive[i] ? 1.0f : 0.0f;
    out[i].rotation = solver.orientation(m_impl->id, i).coeffs().cast<float>();
  }
}

std::uint32_t DestructibleBody::elementAt(const btVector3& place) const {
  const edem::Solver& solver = *m_impl->world->solver;
  const std::uint32_t id = m_impl->id;
  const edem::BodyView view = solver.view(id);
  const edem::CellFaces* cells = solver.cells(id);
  const auto whole = placeOfWhole(*this);
  const Eigen::Vector3d at = whole ? whole->inverse() * bullet::toEigen(place) : bullet::toEigen(place);
  std::uint32_t nearest = kNoElement;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < view.alive.size(); ++i) {
    if (!view.alive[i]) continue;
    const Eigen::Vector3d to = at - (whole ? m_impl->asset->positions[i] : solver.position(id, i));
    const double toCentre = to.norm();
    double out = toCentre;
    if (cells && toCentre < kNear * cells->reach[i])
      out = whole ? outOf(*cells, i, to) : outOf(*cells, i, solver.orientation(id, i).conjugate() * to);
    if (!(out < least)) continue;
    least = out;
    nearest = i;
  }
  return nearest;
}

std::span<const std::uint8_t> DestructibleBody::springsIntact() const {
  return m_impl->world->solver->view(m_impl->id).intact;
}
std::span<const std::uint8_t> DestructibleBody::elementsAlive() const {
  return m_impl->world->solver->view(m_impl->id).alive;
}
std::span<const std::uint32_t> DestructibleBody::fragments() const {
  return m_impl->world->solver->view(m_impl->id).fragment;
}

double DestructibleBody::elementMass() const {
  const edem::BodyView view = m_impl->world->solver->view(m_impl->id);
  double mass = 0;
  for (std::size_t i = 0; i < view.mass.size(); ++i) mass += view.alive[i] ? view.mass[i] : 0;
  return mass;
}

btVector3 DestructibleBody::linearMomentum() const {
  const edem::Solver& solver = *m_impl->world->solver;
  const edem::BodyView view = solver.view(m_impl->id);
  if (isWhole()) return btScalar(m_impl->whole.mass) * getLinearVelocity();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < view.mass.size(); ++i)
    if (view.alive[i]) sum += view.mass[i] * solver.velocity(m_impl->id, i);
  return bullet::toBullet(sum);
}

btVector3 DestructibleBody::angularMomentum() const {
  if (isWhole()) {  // not by Bullet's inverse tensor: that of a hill has no inverse in floats
    const btMatrix3x3& turn = getWorldTransform().getBasis();
    return turn * (m_impl->whole.inertia * (getAngularVelocity() * turn));
  }
  const edem::Solver& solver = *m_impl->world->solver;
  const edem::BodyView view = solver.view(m_impl->id);
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), linear = moment, angular = moment;
  for (std::size_t i = 0; i < view.mass.size(); ++i) {
    if (!view.alive[i]) continue;
    const Eigen::Vector3d x = solver.position(m_impl->id, i),
                          p = view.mass[i] * solver.velocity(m_impl->id, i);
    mass += view.mass[i];
    moment += view.mass[i] * x;
    linear += p;
    angular += x.cross(p) + view.inertia[i] * solver.spin(m_impl->id, i);
  }
  if (mass > 0) angular -= (moment / mass).cross(linear);
  return bullet::toBullet(angular);
}

bool DestructibleBody::isWhole() const {
  return m_impl->state == Impl::State::Whole;
}

bool DestructibleBody::isAsleep() const {
  if (isWhole()) return !isActive();
  return m_impl->world->solver->view(m_impl->id).asleep;
}

RUBBLE_ABI_END
}  // namespace rubble
