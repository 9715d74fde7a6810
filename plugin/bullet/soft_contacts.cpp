#include "bullet/soft_contacts.h"

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// A stand-in is no more than this many times as heavy as the node: of a heavier one floats would lose what it
// is given.
constexpr double kHeaviest = 1000;

struct CellSurface {
  std::uint32_t element = kNoElement;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // out of the cell
  double distance = std::numeric_limits<double>::infinity();
};

// Nothing of the solid is beyond the face.
bool isExposed(const edem::CellFaces::Face& face, const edem::BodyView& view) {
  if (face.neighbour == kNoElement || !view.alive[face.neighbour]) return true;
  return face.spring != edem::CellFaces::kNoSpring && !view.intact[face.spring];
}

// How far a place is out of a cell, by the face that it is furthest out of. Within the cell only a face that
// is exposed is a way out; without one the solid is all round, and it has none here.
CellSurface surfaceOf(const edem::Solver& solver, std::uint32_t body, std::uint32_t element,
                      const Eigen::Vector3d& place) {
  CellSurface surface{element};
  const Eigen::Vector3d to = place - solver.position(body, element);
  const edem::CellFaces* cells = solver.cells(body);
  if (!cells) {
    surface.distance = to.norm() - solver.radius(body);
    surface.normal = to.stableNormalized();
    return surface;
  }
  if (to.squaredNorm() > 4 * cells->reach[element] * cells->reach[element]) return surface;
  const edem::BodyView view = solver.view(body);
  const Eigen::Quaterniond turn = solver.orientation(body, element);
  const Eigen::Vector3d at = turn.conjugate() * to;
  double furthest = -std::numeric_limits<double>::infinity(), way = furthest;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const edem::CellFaces::Face& face : cells->of(element)) {
    const double out = face.normal.dot(at) - face.offset;
    furthest = std::max(furthest, out);
    if (out > way && isExposed(face, view)) {
      way = out;
      normal = face.normal;
    }
  }
  // Beside a cell that goes on there: the neighbour answers.
  if (furthest > 0 && furthest > way) return surface;
  if (normal.isZero(0)) return surface;
  surface.distance = way;
  surface.normal = turn * normal;
  return surface;
}

// Those of deformable bodies are other kinds.
bool isOfKind(const btSoftBody& soft) {
  return (soft.m_cfg.collisions & (btSoftBody::fCollision::SDF_RS | btSoftBody::fCollision::CL_RS)) != 0;
}

bool isSpared(const btSoftBody& soft, const DestructibleBody& own) {
  const auto& disabled = soft.m_collisionDisabledObjects;
  return disabled.findLinearSearch(&own) != disabled.size();
}

// Bullet has added its forces when the narrowphase comes: what lies still is not to have the speed of a fall.
btVector3 velocityBefore(const btSoftBody& soft, const btSoftBody::Node& node) {
  return node.m_im > 0 ? node.m_v - soft.m_worldInfo->m_gravity * soft.m_sst.sdt : node.m_v;
}

}  // namespace

double fastestNode(const btSoftBody& soft) {
  btScalar fastest2 = 0;
  for (int n = 0; n < soft.m_nodes.size(); ++n)
    fastest2 = std::max(fastest2, velocityBefore(soft, soft.m_nodes[n]).length2());
  return std::sqrt(double(fastest2));
}

std::vector<StrikingPoint> strikingNodes(const btSoftBody& soft, const DestructibleBody& own) {
  std::vector<StrikingPoint> points;
  if (!isOfKind(soft) || isSpared(soft, own)) return points;
  points.reserve(std::size_t(soft.m_nodes.size()));
  for (int n = 0; n < soft.m_nodes.size(); ++n) {
    const btSoftBody::Node& node = soft.m_nodes[n];
    if (!node.m_battach)
      points.push_back({toEigen(node.m_q), toEigen(velocityBefore(soft, node)), double(node.m_im)});
  }
  return points;
}

SoftContacts::StandIn::StandIn()
    : rigid(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, nullptr, btVector3(0, 0, 0))) {}

SoftContacts::StandIn& SoftContacts::next() {
  if (m_used == m_standIns.size()) m_standIns.push_back(std::make_unique<StandIn>());
  return *m_standIns[m_used++];
}

void SoftContacts::meet(DestructibleBody& own, btSoftBody& soft, double dt) {
  deliver(*implOf(own).world->solver, dt);
  if (!soft.isActive() || !soft.hasContactResponse() || !own.hasContactResponse()) return;
  if (!isOfKind(soft)) {
    if (m_log && !std::exchange(m_toldOfKind, true))
      m_log(LogLevel::Warning,
            "a soft body passes through destructible bodies of elements: of its kinds of collisions "
            "(m_cfg.collisions) only SDF_RS and CL_RS meet them, not those of deformable bodies");
    return;
  }
  if (isSpared(soft, own)) return;
  const edem::Solver& solver = *implOf(own).world->solver;
  const double margin = double(soft.getCollisionShape()->getMargin());
  Eigen::AlignedBox3d box = implOf(own).shape->box();
  box.min().array() -= margin;
  box.max().array() += margin;
  const btVector3 grow = btVector3(1, 1, 1) * btScalar(margin);
  m_masses.clear();
  for (int n = 0; n < soft.m_nodes.size(); ++n) {
    btSoftBody::Node& node = soft.m_nodes[n];
    const Eigen::Vector3d place = toEigen(node.m_x);
    if (node.m_battach || !box.contains(place)) continue;
    CellSurface nearest;
    for (const std::uint32_t i : implOf(own).shape->elementsNear(node.m_x - grow, node.m_x + grow)) {
      const CellSurface surface = surfaceOf(solver, own.id(), i, place);
      if (std::abs(surface.distance) < std::abs(nearest.distance)) nearest = surface;
    }
    if (!(nearest.distance < margin)) continue;
    if (m_masses.empty()) {
      const edem::BodyView view = solver.view(own.id());
      m_masses.resize(view.alive.size(), 0);
      for (std::size_t i = 0; i < view.alive.size(); ++i)
        if (view.alive[i]) m_masses[view.fragment[i]] += view.mass[i];
    }
    StandIn& standIn = next();
    const double fragment = m_masses[solver.view(own.id()).fragment[nearest.element]];
    const double mass = node.m_im > 0 ? std::min(fragment, kHeaviest / double(node.m_im)) : fragment;
    standIn.own = &own;
    standIn.element = nearest.element;
    standIn.begun = toBullet(Eigen::Vector3d(
        solver.velocity(own.id(), nearest.element) +
        solver.spin(own.id(), nearest.element).cross(place - solver.position(own.id(), nearest.element))));
    standIn.rigid.setMassProps(btScalar(mass), {0, 0, 0});
    standIn.rigid.setLinearVelocity(standIn.begun);
    standIn.rigid.setUserPointer(own.getUserPointer());

    btSoftBody::RContact contact;
    const btVector3 normal = toBullet(nearest.normal);
    contact.m_cti.m_colObj = &standIn.rigid;
    contact.m_cti.m_normal = normal;
    contact.m_cti.m_offset = -normal.dot(node.m_x) + btScalar(nearest.distance - margin);
    contact.m_cti.m_bary = {0, 0, 0};
    contact.m_node = &node;
    const btScalar step = soft.m_sst.sdt, sum = node.m_im + standIn.rigid.getInvMass();
    contact.t1 = contact.t2 = {0, 0, 0};
    contact.m_c0 = btMatrix3x3::getIdentity().scaled(btVector3(1, 1, 1) / (step * sum));
    contact.m_c1 = {0, 0, 0};
    contact.m_c2 = node.m_im * step;
    const btVector3 way = node.m_x - node.m_q - standIn.begun * step;
    const btScalar nears = way.dot(normal);
    const btScalar friction = soft.m_cfg.kDF * btScalar(std::max(0.0, own.material().friction));
    const btVector3 slides = way - normal * nears;
    contact.m_c3 = slides.length2() < nears * friction * nears * friction
                       ? btScalar(0)
                       : btScalar(std::max(0.0, 1 - double(friction)));
    contact.m_c4 = soft.m_cfg.kCHR;
    soft.m_rcontacts.push_back(contact);
  }
}

void SoftContacts::takeOver(DestructibleBody& own, btSoftBody& soft, double dt) {
  auto& contacts = soft.m_rcontacts;
  for (int c = contacts.size() - 1; c >= 0; --c) {
    if (contacts[c].m_cti.m_colObj != &own) continue;
    contacts.swap(c, contacts.size() - 1);
    contacts.pop_back();
  }
  meet(own, soft, dt);
}

void SoftContacts::deliver(edem::Solver& solver, double dt) {
  if (!std::exchange(m_closed, false)) return;
  for (std::size_t s = 0; s < m_used; ++s) {
    StandIn& standIn = *m_standIns[s];
    const btVector3 given = standIn.rigid.getLinearVelocity() - standIn.begun;
    if (!standIn.own || given.isZero() || standIn.own->isWhole()) continue;
    const std::uint32_t id = standIn.own->id();
    if (!solver.view(id).alive[standIn.element]) continue;
    const Eigen::Vector3d force = 1 / (dt * double(standIn.rigid.getInvMass())) * toEigen(given);
    if (!force.allFinite()) continue;
    standIn.own->activate(true);
    solver.setAsleep(id, false);
    const edem::HostLoad load{standIn.element, force, Eigen::Vector3d::Zero()};
    solver.load(id, std::span(&load, 1));
  }
  m_used = 0;
}

void SoftContacts::forget(const DestructibleBody& body) {
  for (const auto& standIn : m_standIns)
    if (standIn->own == &body) standIn->own = nullptr;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
