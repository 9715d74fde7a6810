#include "bullet/world_tick.h"

#include <LinearMath/btQuickprof.h>

#include <utility>

#include "base/stopwatch.h"
#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "rubble/limits.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toEigen;

// Slow bending modes ring for many seconds, for the springs' dashpots damp the fast ones. Fragments that may
// sleep are helped to rest once they have been slower than this for half a second; they rise 3 mm by it
// [m/s]. The half of a wall that a ball went through rings at 0.12.
constexpr double kSettleSpeed = 0.25;

}  // namespace

Destruction::Impl::Impl(btDiscreteDynamicsWorld& bulletWorld, const DestructionDef& definition)
    : world(bulletWorld),
      def(definition),
      solver(edem::Solver::make(definition.precision, {.substepSafety = definition.substepSafety,
                                                       .maxSubstepsPerFrame = definition.maxSubstepsPerFrame,
                                                       .breaking = definition.breaking,
                                                       .crushing = definition.crushing,
                                                       .sleepSpeed = definition.sleep ? kQuietSpeed : 0,
                                                       .settleSpeed = definition.sleep ? kSettleSpeed : 0})),
      algorithms(*static_cast<btCollisionDispatcher*>(bulletWorld.getDispatcher())),
      proxyMaker(definition.log),
      softContacts(definition.log) {
  if (!limits::kMaxEvents.hold(def.maxEvents))
    throw Error("maxEvents: is " + std::to_string(def.maxEvents) + ", must be " + limits::kMaxEvents.text());
  if (!def.debris) return;
  debris::DebrisSystemDef system;
  system.maxDebris = def.maxDebris;
  debrisSystem = std::make_unique<debris::DebrisSystem>(system);
  surroundings = std::make_unique<bullet::DebrisSurroundings>(world, *solver, proxyMaker);
}

void Destruction::Impl::advance(double dt) {
  // Each body's coupler comes, and when nothing is awake all would look at all bodies.
  if (std::exchange(begun, true) || !failure.empty()) return;
  softContacts.deliver(*solver, dt);
  substeps = 0;
  if (elementBodies.empty() && coupledWholes == 0) return;
  BT_PROFILE("Rubble advance");
  takeHostMoves(dt);
  carryAnchored(dt);
  followSleep();
  thawStruck(dt);
  if (!failure.empty()) return;
  if (elementBodies.empty() || !solver->anyAwake()) return;
  advanced = true;
  const base::ScopeTimer timer(times.edem);
  gatherJoints();
  loadJoints(dt);
  gatherProxies(dt);
  energyAlarm.begin(proxies);
  std::vector<edem::RigidProxy> start = proxies;
  {
    BT_PROFILE("Rubble substeps");
    solver->tick(dt, toEigen(world.getGravity()), proxies);
  }
  times.neighbours += solver->report().listing;
  times.edem -= solver->report().listing;
  substeps = solver->report().substeps;
  if (!solver->failure().empty()) {
    failSolver();
    touched.clear();  // gets none of it
    proxies.clear();
    return;
  }
  followElements();
  poseJoints(dt);
  frozen += solver->report().frozen;
  const bool warns = def.log && !solver->report().warning.empty(),
             isFirstFrozen = frozen > 0 && frozen == solver->report().frozen;
  if (warns && (!std::exchange(warned, true) || isFirstFrozen))
    def.log(LogLevel::Warning, solver->report().warning);
  giveBodies(dt, start);
  giveLinks(dt, start);
  for (DestructibleBody* body : elementBodies) implOf(*body).shape->setHidden(true);
}

// What asks from now on, even before the tick is over, finds the elements where the substeps left them.
void Destruction::Impl::followElements() {
  if (!failure.empty()) return;  // places may not be numbers
  for (DestructibleBody* body : elementBodies)
    if (!solver->view(body->id()).lies() || !implOf(*body).lay) implOf(*body).shape->follow();
}

void Destruction::Impl::finish(double dt) {
  BT_PROFILE("Rubble finish");
  advance(dt);
  pushOut.restore(*world.getDispatcher());
  for (DestructibleBody* body : elementBodies) {
    implOf(*body).shape->setHidden(false);
    implOf(*body).near.clear();
  }
  if (advanced) {
    forgetTaken();
    lateImpulses();
    noteReactions(dt);
    fixPositions();
    noteLeftPlaces();
    takeJoints(dt);
    writeAppliedImpulses();
    const base::ScopeTimer timer(times.fracture);
    bookEvents();
    breakElements();
    splitBodies();
  }
  const bool hadDebris = std::exchange(hasDebris, debrisSystem && !debrisSystem->pieces().empty());
  if ((hadDebris || hasDebris) && failure.empty()) {
    const base::ScopeTimer timer(times.debris);
    stepDebris(dt);
    ledgerStale = true;
  }
  gatherLooked(dt);
  noteLoads(dt);
  freezeCalm(dt);
  closeLedger(dt);
  finishThaws();
  showElements();
  failSpoiled(lookedWholes);
  updateSleep(dt);
  for (DestructibleBody* body : elementBodies) implOf(*body).inSolver = false;
  uncoupleIdle();
  pushOut.note(world.getSolverInfo(), dt);
  softContacts.close();
  begun = advanced = false;
  ++ticks;
  seconds += dt;
}

void Destruction::Impl::closeLedger(double dt) {
  // Once more after the last tick of the elements: then no impulse is on its way any more.
  if (!std::exchange(ledgerStale, advanced) && !advanced) return;
  ledgerBook.close(solver->books(), debrisSystem ? debrisSystem->motion() : debris::Motion{});
  double next = 0;
  for (const edem::RigidProxy& proxy : proxies)
    if (advanced && proxy.isDynamic()) next += proxy.givenNext;
  ledgerBook.setExchangedNext(next);
  if (!advanced || !failure.empty()) return;
  const auto lines = energyAlarm.end(touched, proxies, dt, ledgerBook.ledger().energyScale);
  ledgerBook.addMade(energyAlarm.made(), energyAlarm.told());
  if (def.log)
    for (const std::string& line : lines) def.log(LogLevel::Warning, line);
  judgeDamping();
  judgeBalance();
}

RUBBLE_ABI_END
}  // namespace rubble
