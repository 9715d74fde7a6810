#include "debris/debris_system.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "base/hash.h"
#include "rubble/error.h"
#include "rubble/limits.h"

namespace rubble::debris {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr double kLongestStep = 1e6;  // [s]: with kLargest it keeps every product of a step finite

void requireRange(double value, double least, double most, const char* name) {
  if (value >= least && value <= most) return;
  throw Error(std::string("debris: ") + name + " is " + std::to_string(value) + ", must be " +
              std::to_string(least) + " to " + std::to_string(most));
}

void requireUsable(const Eigen::Vector3d& value, const char* name) {
  if (!isUsable(value)) throw Error(std::string("debris: ") + name + " is not finite, or larger than 1e12");
}

void validate(const DebrisParcel& parcel) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  requireRange(parcel.mass, kLeast, kLargestAmount, "mass of a piece");
  requireRange(parcel.radius, kLeast, kLargest, "radius of a piece");
  requireRange(parcel.density, kLeast, kLargest, "density of a piece");
  requireRange(parcel.inertia, 0, kLargestAmount, "inertia of a piece");
  requireRange(parcel.collisionRadius, 0, kLargest, "collision radius of a piece");
  requireRange(parcel.friction, 0, kLargest, "friction of a piece");
  requireRange(parcel.scale, 0, kLargest, "drawn scale of a piece");
  requireUsable(parcel.position, "place of a piece");
  requireUsable(parcel.velocity, "velocity of a piece");
  requireUsable(parcel.spin, "spin of a piece");
  requireRange(parcel.orientation.norm(), 0.999, 1.001, "norm of a piece's orientation");
}

Eigen::Quaternionf turned(const Eigen::Quaternionf& orientation, const Eigen::Vector3d& spin, double dt) {
  const double rate = spin.norm();
  if (!(rate > 0)) return orientation;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(rate * dt, spin / rate));
  return (turn.cast<float>() * orientation).normalized();
}

}  // namespace

DebrisSystem::DebrisSystem(const DebrisSystemDef& def)
    : m_def(def), m_moving{kNone, kNone, 0}, m_resting{kNone, kNone, 0} {
  requireRange(def.maxDebris, limits::kMaxDebris.low, limits::kMaxDebris.high, "maxDebris");
  requireRange(def.air.density, 0, kLargest, "density of the air");
  requireRange(def.air.viscosity, 0, kLargest, "viscosity of the air");
  requireRange(def.restitution, 0, 1, "restitution");
  requireRange(def.restSpeed, 0, kLargest, "restSpeed");
  requireRange(def.restTime, 0, kLargest, "restTime");
  requireRange(def.reach, std::numeric_limits<double>::min(), kLargest, "reach");
  m_particles.reserve(def.maxDebris);
  m_pieces.reserve(def.maxDebris);
  m_links.reserve(def.maxDebris);
}

void DebrisSystem::add(std::span<const DebrisParcel> parcels) {
  for (const DebrisParcel& parcel : parcels) {
    validate(parcel);
    if (m_particles.size() >= m_def.maxDebris) {
      remove(m_resting.count > 0 ? m_resting.first : m_moving.first);
    }
    addOne(parcel);
  }
}

void DebrisSystem::addOne(const DebrisParcel& parcel) {
  const auto index = std::uint32_t(m_particles.size());
  m_particles.push_back({.position = parcel.position,
                         .velocity = parcel.velocity,
                         .spin = parcel.spin,
                         .mass = parcel.mass,
                         .inertia = parcel.inertia,
                         .drag = grainDrag(m_def.air, parcel.density, parcel.radius),
                         .collisionRadius = parcel.collisionRadius,
                         .friction = parcel.friction,
                         .stillAt = parcel.position,
                         .stillTime = 0,
                         .support = kFixedSurface,
                         .supports = {},
                         .touched = false,
                         .offset = parcel.offset});
  m_pieces.push_back({.position = parcel.position.cast<float>(),
                      .velocity = parcel.velocity.cast<float>(),
                      .orientation = parcel.orientation.cast<float>(),
                      .spin = parcel.spin.cast<float>(),
                      .radius = float(parcel.radius),
                      .mass = float(parcel.mass),
                      .scale = float(parcel.scale),
                      .body = parcel.body,
                      .element = parcel.element,
                      .resting = false});
  m_links.push_back({kNone, kNone});
  append(m_moving, index);
  const Motion motion = motionOf(m_particles[index]);
  m_mass += motion.mass;
  m_motion += motion;
  m_exchange.added += motion;
  ++m_exchange.addedCount;
}

void DebrisSystem::step(double dt, const Eigen::Vector3d& gravity, DebrisCollider& collider) {
  requireRange(dt, 0, kLongestStep, "time step");
  requireUsable(gravity, "gravity");
  beginStep(dt, gravity, collider);
  if (!(dt > 0)) return;
  const StepInput input{dt, gravity, m_def.restitution, &collider};
  const StepBooks books{&m_exchange, &m_surfaces};
  m_motion = {};
  bool strays = false;
  for (std::uint32_t index = m_moving.first; index != kNone;) {
    const std::uint32_t next = m_links[index].next;
    Particle& particle = m_particles[index];
    advance(particle, input, books);
    if (comesToRest(particle, dt)) {
      bringToRest(particle, books);
      rest(index, collider);
    }
    updatePiece(index, dt);
    m_motion += motionOf(particle);
    strays |= isStray(index);
    index = next;
  }
  if (strays) removeStrays();
}

void DebrisSystem::beginStep(double dt, const Eigen::Vector3d& gravity, DebrisCollider& collider) {
  Eigen::AlignedBox3d swept;
  const double fall = gravity.norm() * dt * dt;
  for (std::uint32_t index = m_moving.first; index != kNone; index = m_links[index].next) {
    const Particle& p = m_particles[index];
    const Eigen::Vector3d reach =
        Eigen::Vector3d::Constant(p.velocity.norm() * dt + fall + p.collisionRadius + p.offset.norm());
    swept.extend(p.position - reach);
    swept.extend(p.position + reach);
  }
  if (!swept.isEmpty()) collider.begin(swept);
  m_surfaces.begin(collider);  // it has seen what is near
}

// By the way and not by the speed: what lies between several surfaces goes on trembling.
bool DebrisSystem::comesToRest(Particle& particle, double dt) const {
  const double way = m_def.restSpeed * std::max(m_def.restTime, dt);
  const bool still = (particle.position - particle.stillAt).norm() <= way;
  if (!still) {
    particle.stillAt = particle.position;
    particle.supports.count = 0;
  }
  particle.stillTime = still ? particle.stillTime + dt : 0;
  return particle.touched && particle.stillTime >= m_def.restTime && still;
}

void DebrisSystem::updatePiece(std::uint32_t index, double dt) {
  const Particle& particle = m_particles[index];
  DebrisPiece& piece = m_pieces[index];
  piece.position = particle.position.cast<float>();
  piece.velocity = particle.velocity.cast<float>();
  piece.orientation = turned(piece.orientation, particle.spin, dt);
  piece.spin = particle.spin.cast<float>();
}

bool DebrisSystem::isStray(std::uint32_t index) const {
  const Particle& particle = m_particles[index];
  if (!particle.position.allFinite() || !particle.velocity.allFinite())
    throw Error("debris: piece " + std::to_string(index) + " is no longer finite");
  return (particle.position.array().abs() > m_def.reach).any();
}

// From the back, so that what fills a hole has been looked at.
void DebrisSystem::removeStrays() {
  for (auto index = std::uint32_t(m_particles.size()); index-- > 0;) {
    if (isStray(index)) remove(index);
  }
}

void DebrisSystem::rest(std::uint32_t index, DebrisCollider& collider) {
  if (m_resting.count == 0) m_restBounds.setEmpty();
  m_restBounds.extend(m_particles[index].position);
  unlink(m_moving, index);
  append(m_resting, index);
  m_pieces[index].resting = true;
  for (const std::uint32_t id : m_particles[index].supports)
    if (id != kFixedSurface) collider.noteSupport(id);
}

// Through the array and not through the list, which jumps about in memory: five times faster.
template <typename Choose>
std::uint32_t DebrisSystem::wakeIf(Choose choose) {
  std::uint32_t woken = 0;
  for (std::uint32_t index = 0; index < m_particles.size(); ++index) {
    if (!m_pieces[index].resting || !choose(m_particles[index])) continue;
    unlink(m_resting, index);
    append(m_moving, index);
    m_pieces[index].resting = false;
    m_particles[index].stillAt = m_particles[index].position;
    m_particles[index].stillTime = 0;
    m_particles[index].supports.count = 0;
    ++woken;
  }
  return woken;
}

std::uint32_t DebrisSystem::wake(std::span<const Eigen::AlignedBox3d> boxes) {
  if (m_resting.count == 0) return 0;
  const bool near = std::any_of(boxes.begin(), boxes.end(), [this](const Eigen::AlignedBox3d& box) {
    return !box.isEmpty() && box.intersects(m_restBounds);
  });
  if (!near) return 0;
  return wakeIf([boxes](const Particle& particle) {
    return std::any_of(boxes.begin(), boxes.end(), [&particle](const Eigen::AlignedBox3d& box) {
      return box.contains(particle.position);
    });
  });
}

std::uint32_t DebrisSystem::wakeSupports(std::span<const std::uint32_t> surfaces) {
  if (m_resting.count == 0 || surfaces.empty()) return 0;
  m_leaving.resize(std::max<std::size_t>(m_leaving.size(), m_surfaces.count()), 0);
  const auto mark = [&](std::uint8_t as) {
    for (const std::uint32_t id : surfaces)
      if (id < m_leaving.size()) m_leaving[id] = as;
  };
  mark(1);
  const std::uint32_t woken = wakeIf([this](const Particle& particle) {
    return std::any_of(particle.supports.begin(), particle.supports.end(),
                       [this](std::uint32_t id) { return id != kFixedSurface && m_leaving[id] != 0; });
  });
  mark(0);
  return woken;
}

std::uint32_t DebrisSystem::removeBody(std::uint32_t body) {
  std::uint32_t removed = 0;
  for (auto index = std::uint32_t(m_particles.size()); index-- > 0;) {
    if (m_pieces[index].body != body) continue;
    remove(index);
    ++removed;
  }
  return removed;
}

void DebrisSystem::remove(std::uint32_t index) {
  const Motion motion = motionOf(m_particles[index]);
  m_exchange.removed += motion;
  ++m_exchange.removedCount;
  m_mass -= motion.mass;
  m_motion -= motion;
  unlink(m_pieces[index].resting ? m_resting : m_moving, index);
  fillHole(index);
  if (m_particles.empty()) {  // no rounding is carried over from pieces that are gone
    m_mass = 0;
    m_motion = {};
  }
}

// The last piece moves into the place of a removed one.
void DebrisSystem::fillHole(std::uint32_t index) {
  const auto last = std::uint32_t(m_particles.size() - 1);
  if (index != last) {
    m_particles[index] = m_particles[last];
    m_pieces[index] = m_pieces[last];
    m_links[index] = m_links[last];
    List& list = m_pieces[index].resting ? m_resting : m_moving;
    const Link link = m_links[index];
    (link.previous != kNone ? m_links[link.previous].next : list.first) = index;
    (link.next != kNone ? m_links[link.next].previous : list.last) = index;
  }
  m_particles.pop_back();
  m_pieces.pop_back();
  m_links.pop_back();
}

void DebrisSystem::append(List& list, std::uint32_t index) {
  m_links[index] = {list.last, kNone};
  (list.last != kNone ? m_links[list.last].next : list.first) = index;
  list.last = index;
  ++list.count;
}

void DebrisSystem::unlink(List& list, std::uint32_t index) {
  const Link link = m_links[index];
  (link.previous != kNone ? m_links[link.previous].next : list.first) = link.next;
  (link.next != kNone ? m_links[link.next].previous : list.last) = link.previous;
  --list.count;
}

Motion DebrisSystem::motion() const {
  Motion motion = m_motion;
  motion.mass = m_mass;
  return motion;
}

Exchange DebrisSystem::takeExchange() {
  const Exchange taken = m_exchange;
  m_exchange = {};
  return taken;
}

std::uint64_t DebrisSystem::hash() const {
  base::Fnv1a hash;
  for (std::size_t i = 0; i < m_particles.size(); ++i) {
    const Particle& particle = m_particles[i];
    const DebrisPiece& piece = m_pieces[i];
    hash.addAll(particle.position);
    hash.addAll(particle.velocity);
    hash.addAll(particle.spin);
    hash.addAll(piece.orientation.coeffs());
    hash.add(particle.mass);
    hash.add(piece.radius);
    hash.add(piece.body);
    hash.add(piece.element);
    hash.add(std::uint64_t{piece.resting});
  }
  return hash.value();
}

}  // namespace rubble::debris
