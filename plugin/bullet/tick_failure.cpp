// What ends the simulation, and how that is told.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <string>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

// A run stops when dashpots, friction and restitution made more than this share of the energy in the world:
// more than was put in. A blow that lasts has up to a tenth for a while (a crate of 50 kg on a slab), for
// energy that restitution withholds while the surface still nears counts only as it parts.
constexpr double kRunaway = 0.5;

}  // namespace

void Destruction::Impl::judgeDamping() {
  const double made = -ledgerBook.lostByElements(), most = ledgerBook.ledger().energyScale;
  // The ledger is of the instant of the last forces: in a first tick of one substep nothing had moved yet,
  // and rounding is all the energy there is.
  if (bodies.empty() || ticks == 0 || !(made > kRunaway * most)) return;
  char text[240];
  std::snprintf(text, sizeof text,
                "what should take energy from the elements, of which its are the fastest, made %.3g J of the "
                "%.3g J in the world; lower substepSafety, or raise the material's restitution",
                made, most);
  fail(fastest(), text);
}

const DestructibleBody& Destruction::Impl::fastest() const {
  const auto slower = [&](const DestructibleBody* a, const DestructibleBody* b) {
    return solver->maxSpeed(a->id()) < solver->maxSpeed(b->id());
  };
  return **std::max_element(bodies.begin(), bodies.end(), slower);
}

// Bullet's places, and those that elements are told in, are floats: what they are wrong by, on both sides of
// a contact, in weights. And what counts as still may move.
double Destruction::Impl::roundedEnergy() const {
  const edem::Books& books = solver->books();
  double extent = books.centre.norm() + books.diagonal;
  for (const edem::RigidProxy& proxy : proxies)
    extent = std::max(extent, proxy.position.norm() + proxy.reach());
  const double wrong = 8 * double(std::numeric_limits<float>::epsilon()) * extent;
  return books.initialMass * (double(world.getGravity().length()) * wrong + 0.5 * kQuietSpeed * kQuietSpeed);
}

void Destruction::Impl::judgeBalance() {
  if (bodies.empty() || solver->report().substeps == 0) return;
  energyBalance.noteShapes(proxies);
  const std::optional<double> held =
      energyBalance.beyond(solver->books(), energyAlarm.largestKinetic(), roundedEnergy());
  if (!held) return;
  const DestructibleBody& body = fastest();
  const std::span<const std::uint8_t> alive = solver->view(body.id()).alive;
  const auto speed = [&](std::size_t i) {
    return alive[i] ? solver->velocity(body.id(), i).squaredNorm() : -1.0;
  };
  std::size_t first = 0;
  for (std::size_t i = 1; i < alive.size(); ++i)
    if (speed(i) > speed(first)) first = i;
  char text[500];
  std::snprintf(
      text, sizeof text,
      "its elements, the fastest of which is %zu, and those of other bodies hold %.3g J where "
      "no more than %.3g J were ever put in: contacts make energy that are pressed too deep, or met "
      "too fast, for a substep of %.3g s; lower substepSafety, or raise maxSubstepsPerFrame, "
      "contactStiffness or the size of the elements",
      first, *held, energyBalance.most(), solver->report().substep);
  fail(body, text);
}

// The first failure counts.
void Destruction::Impl::fail(const DestructibleBody& body, const std::string& what) {
  if (!failure.empty()) return;
  const DestructibleBody::Impl& own = implOf(body);
  failure = own.name + ": " + what + (own.advice.empty() ? "" : "; " + own.advice) + whenText();
}

std::string Destruction::Impl::whenText() const {
  char text[80];
  std::snprintf(text, sizeof text, " (tick %llu, after %.6g s)", static_cast<unsigned long long>(ticks),
                seconds);
  return text;
}

// The solver's message begins with the body, "body 3: ".
void Destruction::Impl::failSolver() {
  const std::string& text = solver->failure();
  for (const DestructibleBody* body : bodies) {
    const std::string head = "body " + std::to_string(body->id()) + ": ";
    if (text.starts_with(head)) return fail(*body, text.substr(head.size()));
  }
  failure = text + whenText();
}

// By the application, a joint or a neighbour: elements would follow.
void Destruction::Impl::failSpoiled(std::span<DestructibleBody* const> looked) {
  for (const DestructibleBody* body : looked) {
    const btTransform& at = body->getWorldTransform();
    const btMatrix3x3& turn = at.getBasis();
    const btVector3 sum =
        at.getOrigin() + turn[0] + turn[1] + turn[2] + body->getLinearVelocity() + body->getAngularVelocity();
    if ((0 * sum).isZero()) continue;
    fail(*body,
         "while Bullet moved it as one rigid body its place or velocity became no finite number; look for "
         "what set it, or for forces and joints on it");
  }
}

RUBBLE_ABI_END
}  // namespace rubble
