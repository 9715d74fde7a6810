#include "rubble/events.h"

namespace rubble {

void Events::clear() {
  springsBroken.clear();
  elementsCrushed.clear();
  debrisSpawned.clear();
  fragmentsSplit.clear();
  bodiesSplit.clear();
  contacts.clear();
  dustSources.clear();
  dropped = 0;
}

}  // namespace rubble
