#include "debris/particle.h"

#include <algorithm>
#include <cmath>
#include <string>

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
                     std::abs(hit.normal.norm() - 1) < kNormalTolerance && isUsable(hit.surfaceVelocity) &&
                     hit.inverseMass >= 0 && hit.inverseMass <= kLargest;
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
  checkHit(hit, books.surfaces.size());
  hit.normal.normalize();
  return way.dot(hit.normal) <= 0;
}

// From here to where the hit sets the ball down. A ball that overlapped the surface is put outside by it.
Eigen::Vector3d wayToHit(const Particle& p, const DebrisHit& hit) {
  return hit.point + (p.collisionRadius + kGap) * hit.normal - p.position;
}

void bookContact(const DebrisHit& hit, const Impulse& change, const StepBooks& books) {
  Exchange& exchange = *books.exchange;
  exchange.contact += change;
  // The surface's velocity changes in proportion to the impulse, so its mean over the hit does the work.
  exchange.workOnSurfaces +=
      -change.linear.dot(hit.surfaceVelocity) + 0.5 * hit.inverseMass * change.linear.squaredNorm();
  if (hit.surface == kFixedSurface) return;
  SurfaceImpulse& surface = books.surfaces[hit.surface];
  surface.linear -= change.linear;
  surface.angular -= change.angular;
  ++surface.hits;
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

// Newton's restitution and Coulomb's friction on a point: the impulse along the normal is J = m' (1 + e) u_n,
// the one along the surface at most mu J and never more than stops the sliding; m' is the reduced mass. The
// surface's inverse mass along the normal stands for that along the surface too. Returns the velocity after a
// hit at `velocity`.
Eigen::Vector3d velocityAfterHit(const Particle& p, const Eigen::Vector3d& velocity, const DebrisHit& hit,
                                 double restitution) {
  const Eigen::Vector3d relative = velocity - hit.surfaceVelocity;
  const double approach = -relative.dot(hit.normal);
  if (!(approach > 0)) return velocity;
  const double reduced = 1 / (1 + p.mass * hit.inverseMass);  // m' / m
  const double push = reduced * (1 + restitution) * approach;
  const Eigen::Vector3d sliding = relative + approach * hit.normal;
  const double slip = sliding.norm();
  const double grip = slip > 0 ? std::min(p.friction * push / slip, reduced) : 0;
  return velocity + push * hit.normal - grip * sliding;
}

// A hit leaves the share e of the spin: a point has no arm for friction to turn it by, and a piece that has
// come to rest must not spin. `flown` is what the way to the surface left over; it is the surface's.
void hitSurface(Particle& p, const DebrisHit& hit, double restitution, const Impulse& flown,
                const StepBooks& books) {
  const Motion before = motionOf(p);
  p.velocity = velocityAfterHit(p, p.velocity, hit, restitution);
  p.spin *= restitution;
  Impulse change = changeOf(before, motionOf(p));
  change += flown;
  bookContact(hit, change, books);
  p.support = hit.surface;
  p.touched = true;
}

// The rest of a step in contact: gravity presses the piece on the surface and friction slows it. It moves
// along the surface with the mean of its velocities until something else is in the way. `rate` is of the drag
// [1/s].
void slide(Particle& p, const DebrisHit& floor, double time, double rate, const StepInput& input,
           const StepBooks& books) {
  Flight flight = fly(p.velocity, input.gravity, rate, time);
  flight.displacement = 0.5 * time * (p.velocity + velocityAfterHit(p, flight.velocity, floor, 0));
  flight.displacement -= std::min(flight.displacement.dot(floor.normal), 0.0) * floor.normal;

  DebrisHit wall;
  const bool blocked = findHit(p, flight.displacement, input, books, wall);
  if (blocked) flight.displacement = wayToHit(p, wall);
  const Impulse flown = coast(p, flight, time, input, *books.exchange);
  hitSurface(p, floor, 0, flown, books);
  if (blocked) hitSurface(p, wall, input.restitution, {}, books);
}

}  // namespace

void advance(Particle& p, const StepInput& input, const StepBooks& books) {
  p.touched = false;
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
    until.displacement = wayToHit(p, hit);
    const Impulse flown = coast(p, until, time, input, *books.exchange);
    const double approach = (hit.surfaceVelocity - p.velocity).dot(hit.normal);
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
  bookContact({.surface = p.support}, changeOf(before, motionOf(p)), books);
}

}  // namespace rubble::debris
