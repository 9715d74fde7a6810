#include "debris/particle.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "debris/contact.h"
#include "rubble/error.h"

namespace rubble::debris {

namespace {

// Hits followed in one step; a piece that has more is in a corner and waits there for the next step.
constexpr int kMaxHits = 4;
// A piece is set down this far from the surface [m], so that the next sweep does not start inside it by
// rounding. Float geometry at 100 m is exact to 4e-6 m; a gap of 1e-5 m cannot be seen.
constexpr double kGap = 1e-5;
// A bounce slower than gravity's work of this many steps is none: it would be over before it could be
// resolved.
constexpr double kBounceSteps = 2;
// How far from 1 the length of a collider's normal may be.
constexpr double kNormalTolerance = 1e-3;

void checkHit(const DebrisHit& hit, std::size_t surfaceCount) {
  const bool valid = hit.fraction >= 0 && hit.fraction <= 1 && isUsable(hit.point) &&
                     std::abs(hit.normal.norm() - 1) < kNormalTolerance;
  if (!valid) throw Error("debris: the collider gave a hit that is not finite or out of range");
  if (hit.surface != kFixedSurface && hit.surface >= surfaceCount)
    throw Error("debris: the collider gave surface " + std::to_string(hit.surface) + " of " +
                std::to_string(surfaceCount));
}

// The first hit on the way; false when the way is free.
bool findHit(const Particle& p, const Eigen::Vector3d& way, const StepInput& input, const StepBooks& books,
             DebrisHit& hit) {
  hit = {};
  if (!input.collider->sweep(p.position, p.position + way, p.collisionRadius, hit)) return false;
  checkHit(hit, books.surfaces->count());
  hit.normal.normalize();
  return way.dot(hit.normal) <= 0;
}

// From here to where the hit sets the ball down. A ball that overlapped the surface is put outside by it, but
// not through a thin one: what lies on a terrain under a boulder stays above it.
Eigen::Vector3d wayToHit(const Particle& p, const DebrisHit& hit, const StepInput& input) {
  const auto wayTo = [&p](const DebrisHit& h) -> Eigen::Vector3d {
    return h.point + (p.collisionRadius + kGap) * h.normal - p.position;
  };
  const Eigen::Vector3d way = wayTo(hit);
  const bool isPutOut = hit.fraction <= 0;
  DebrisHit thin;
  const bool isHeld =
      isPutOut && input.collider->sweepThin(p.position, p.position + way, p.collisionRadius, thin);
  return isHeld ? wayTo(thin) : way;
}

// Books a change of the piece's motion by contact, and gives the surface what the piece lost.
void bookContact(std::uint32_t surface, const Impulse& change, const StepBooks& books) {
  books.exchange->contact += change;
  books.exchange->workOnSurfaces += books.surfaces->give(surface, change);
}

// The same for a change that no law of contact stands behind: setting a piece down beside its parabola, or
// stopping it. `spent` is what the contact has dissipated so far [J]; what would make more energy than that
// is booked as if the piece had it from outside.
void bookRemainder(std::uint32_t surface, const Impulse& change, double spent, const StepBooks& books) {
  const bool makesEnergy = change.energy + books.surfaces->workOf(surface, change) > spent;
  if (makesEnergy) books.exchange->placed += std::max(0.0, change.energy - std::max(0.0, spent));
  bookContact(makesEnergy ? kFixedSurface : surface, change, books);
}

// Moves a piece along a flight and books gravity's and the air's impulse at the middle of the way. Returns
// what is left of the change: 0 in free fall without a hit; a flight that a surface cuts short ends beside
// its parabola.
Impulse coast(Particle& p, const Flight& flight, double time, const StepInput& input, Exchange& exchange) {
  const Motion before = motionOf(p);
  const Eigen::Vector3d middle = p.position + 0.5 * flight.displacement;
  const Eigen::Vector3d meanVelocity = 0.5 * (p.velocity + flight.velocity);
  const Eigen::Vector3d weight = p.mass * time * input.gravity;
  const Eigen::Vector3d drag = p.mass * (flight.velocity - p.velocity) - weight;
  p.position += flight.displacement;
  p.velocity = flight.velocity;

  const Impulse fromGravity{weight, middle.cross(weight), p.mass * input.gravity.dot(flight.displacement)};
  const Impulse fromAir{drag, middle.cross(drag), drag.dot(meanVelocity)};
  exchange.gravity += fromGravity;
  exchange.air += fromAir;
  const Impulse change = changeOf(before, motionOf(p));
  return {Eigen::Vector3d::Zero(), change.angular - fromGravity.angular - fromAir.angular,
          change.energy - fromGravity.energy - fromAir.energy};
}

// `flown` is what the way to the surface left over; it is the surface's.
void hitSurface(Particle& p, const DebrisHit& hit, double restitution, const Impulse& flown,
                const StepBooks& books) {
  const Exchange& exchange = *books.exchange;
  const double before = exchange.contact.energy + exchange.workOnSurfaces;
  const Motion flying = motionOf(p);
  p.velocity = velocityAfterHit(p, p.velocity, hit.normal, restitution, books.surfaces->of(hit.surface));
  const Motion bounced = motionOf(p);
  bookContact(hit.surface, changeOf(flying, bounced), books);
  p.spin = spinAfterHit(p, restitution, books.surfaces->of(hit.surface));
  bookContact(hit.surface, changeOf(bounced, motionOf(p)), books);
  const double spent = before - exchange.contact.energy - exchange.workOnSurfaces;
  bookRemainder(hit.surface, flown, spent, books);
  p.support = hit.surface;
  p.supports.add(hit.surface);
  p.touched = true;
}

// The rest of a step in contact: gravity presses the piece on the surface and friction slows it. It moves
// along the surface with the mean of its velocities until something else is in the way. `rate` is of the drag
// [1/s].
void slide(Particle& p, const DebrisHit& floor, double time, double rate, const StepInput& input,
           const StepBooks& books) {
  Flight flight = fly(p.velocity, input.gravity, rate, time);
  flight.displacement =
      0.5 * time *
      (p.velocity + velocityAfterHit(p, flight.velocity, floor.normal, 0, books.surfaces->of(floor.surface)));
  // Surfaces stand within a step, so what has been hit away, or moves away, has not made room yet. The piece
  // that goes with it waits: beside its own path its momentum would turn the surface.
  if (p.velocity.dot(floor.normal) * time < -kGap) flight.displacement.setZero();
  flight.displacement -= std::min(flight.displacement.dot(floor.normal), 0.0) * floor.normal;

  DebrisHit wall;
  const bool blocked = findHit(p, flight.displacement, input, books, wall);
  if (blocked) flight.displacement = wayToHit(p, wall, input);
  const Impulse flown = coast(p, flight, time, input, *books.exchange);
  hitSurface(p, floor, 0, flown, books);
  if (blocked) hitSurface(p, wall, input.restitution, {}, books);
}

// A piece begins where it was inside its element, of which a part may have been beyond a thin surface.
void begin(Particle& p, const StepInput& input, const StepBooks& books) {
  const Eigen::Vector3d offset = std::exchange(p.offset, Eigen::Vector3d::Zero());
  DebrisHit hit;
  if (offset.isZero(0) || !input.collider->sweepThin(p.position - offset, p.position, p.collisionRadius, hit))
    return;
  checkHit(hit, books.surfaces->count());
  const Motion before = motionOf(p);
  p.position = hit.point + (p.collisionRadius + kGap) * hit.normal;
  bookContact(hit.surface, changeOf(before, motionOf(p)), books);
}

}  // namespace

void Supports::add(std::uint32_t id) {
  if (std::find(begin(), end(), id) != end()) return;
  if (count == ids.size()) std::rotate(ids.begin(), ids.begin() + 1, ids.end());
  count = std::min(count + 1, std::uint32_t(ids.size()));
  ids[count - 1] = id;
}

void advance(Particle& p, const StepInput& input, const StepBooks& books) {
  p.touched = false;
  begin(p, input, books);
  const double slowest = kBounceSteps * input.gravity.norm() * input.dt;
  double left = input.dt;
  for (int hits = 0; hits < kMaxHits && left > 0; ++hits) {
    const double rate = stepDragRate(p.drag, p.velocity, input.gravity, left);
    const Flight flight = fly(p.velocity, input.gravity, rate, left);
    DebrisHit hit;
    if (!findHit(p, flight.displacement, input, books, hit)) {
      const Impulse flown = coast(p, flight, left, input, *books.exchange);
      books.exchange->air += flown;
      return;
    }
    const double time = hit.fraction * left;
    Flight until = fly(p.velocity, input.gravity, rate, time);
    until.displacement = wayToHit(p, hit, input);
    const Impulse flown = coast(p, until, time, input, *books.exchange);
    const Eigen::Vector3d surface = books.surfaces->of(hit.surface).velocityAt(p.position);
    const double approach = (surface - p.velocity).dot(hit.normal);
    const bool bounces = input.restitution * approach > slowest;
    hitSurface(p, hit, bounces ? input.restitution : 0, flown, books);
    left -= time;
    if (!bounces) {
      slide(p, hit, left, rate, input, books);
      return;
    }
  }
}

void bringToRest(Particle& p, const StepBooks& books) {
  const Motion before = motionOf(p);
  p.velocity.setZero();
  p.spin.setZero();
  bookRemainder(p.support, changeOf(before, motionOf(p)), 0, books);
}

}  // namespace rubble::debris
