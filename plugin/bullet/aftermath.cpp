// What is left of the elements that a tick has crushed: debris and dust.
#include <LinearMath/btQuickprof.h>

#include <string>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"
#include "debris/bond.h"

namespace rubble {
RUBBLE_ABI_BEGIN

// Crushed elements become debris and dust (paper 3.2, 3.3).
void Destruction::Impl::breakElements() {
  BT_PROFILE("Rubble break elements");
  Events& out = events[filling];
  for (base::CrushedElement c : solver->report().crushed) {
    DestructibleBody* body = bodyOf(c.body);
    if (!body) continue;
    DestructibleBody::Impl& own = implOf(*body);
    ++crushed;
    c.maxRadius = debris::maxRadius(own.bondConstants[c.element], c.fractureEnergy);
    try {
      own.spawner->spawn(c, own.asset->cellFaces(c.element), batch);
    } catch (const Error& error) {  // numbers that have run away
      return fail(*body,
                  "element " + std::to_string(c.element) + " crushed: " + error.what() +
                      "; lower substepSafety, or look for units other than metres, seconds, kilograms");
    }
    if (debrisSystem) {
      debrisSystem->add(batch.pieces);
      ledgerBook.addGiven(batch.energyGiven);
    } else {
      const debris::Motion whole = debris::motionOf(c.mass, c.inertia, c.centre, c.velocity, c.spin);
      debris::Motion rest = whole;
      rest -= batch.dustMotion;
      ledgerBook.addRemoved(rest);
    }
    ledgerBook.addDust(batch.dustMotion);
    const std::uint32_t pieces = debrisSystem ? std::uint32_t(batch.pieces.size()) : 0;
    debrisSpawned += pieces;
    record(out.elementsCrushed,
           {c.body, c.element, pieces, float(c.mass), float(batch.dustMotion.mass), float(c.fractureEnergy),
            float(c.maxRadius), c.centre.cast<float>(), c.velocity.cast<float>()});
    for (std::uint32_t p = 0; p < pieces; ++p)
      record(out.debrisSpawned,
             {c.body, c.element, float(batch.pieces[p].radius), float(batch.pieces[p].mass)});
    if (batch.dustMotion.mass > 0)
      record(out.dustSources, {c.centre.cast<float>(), c.velocity.cast<float>(), float(batch.dustMotion.mass),
                               float(own.material.dustRadius)});
  }
}

void Destruction::Impl::stepDebris(double dt) {
  BT_PROFILE("Rubble step debris");
  if (debrisSystem->restingCount() > 0) {
    debrisSystem->wakeSupports(surroundings->supports().takeDeparted());
    for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
      const btCollisionObject* object = world.getCollisionObjectArray()[i];
      const btRigidBody* rigid = btRigidBody::upcast(object);
      const bool moves = rigid && (object->isKinematicObject() || !object->isStaticObject());
      if (!moves || !rigid->isActive() || upcastElements(object)) continue;
      if (double(rigid->getLinearVelocity().length()) < kQuietSpeed) continue;
      btVector3 low, high;
      rigid->getAabb(low, high);
      wakeBoxes.emplace_back(bullet::toEigen(low), bullet::toEigen(high));
    }
    if (!wakeBoxes.empty()) debrisSystem->wake(wakeBoxes);
  } else {
    surroundings->supports().clear();
  }
  wakeBoxes.clear();
  if (debrisSystem->movingCount() > 0) {
    try {
      debrisSystem->step(dt, bullet::toEigen(world.getGravity()), *surroundings);
    } catch (const Error& error) {  // numbers that have run away
      failure = error.what() + whenText();
      return;
    }
    ledgerBook.addPush(surroundings->push(debrisSystem->surfaceImpulses()));
  }
  const debris::Exchange exchange = debrisSystem->takeExchange();
  debrisRemoved += std::uint32_t(exchange.removedCount);
  ledgerBook.addExchange(exchange);
}

RUBBLE_ABI_END
}  // namespace rubble
