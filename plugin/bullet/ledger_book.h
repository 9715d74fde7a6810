// Joins the books of elements, debris and dust into the ledger.
#pragma once

#include "bullet/debris_surroundings.h"
#include "debris/debris_system.h"
#include "debris/motion.h"
#include "edem/books.h"
#include "rubble/abi.h"
#include "rubble/ledger.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

class LedgerBook {
 public:
  /// What of a crushed element became dust; the energy its debris were given; what left altogether.
  void addDust(const debris::Motion& dust) { m_dust += dust; }
  void addGiven(double energy) { m_given += energy; }
  void addRemoved(const debris::Motion& removed) { m_removed += removed; }
  void addExchange(const debris::Exchange& exchange);
  /// Between debris and elements: no exchange with Bullet, though debris and elements both book it as one
  /// with a stranger. What the elements received more or less than the debris gave shows as an error.
  void addPush(const ElementPush& push);

  /// What dynamic bodies do in the half substep after the last instant of forces [J].
  void setExchangedNext(double energy) { m_ledger.exchangedNext = energy; }
  /// What EnergyAlarm found, up to now.
  void addMade(double energy, std::uint32_t bodies);

  /// At the end of each tick.
  void close(const edem::Books& books, const debris::Motion& debris);
  const Ledger& ledger() const { return m_ledger; }
  /// What elements lost by dashpots, friction, restitution, breaks and sleep. Below 0: what should take
  /// energy made some [J].
  double lostByElements() const { return m_lostByElements; }

 private:
  double momentumScale(const edem::Books& books, const debris::Motion& debris);

  Ledger m_ledger;
  debris::Motion m_dust, m_removed;
  debris::Impulse m_gravity, m_air, m_contact;
  ElementPush m_push;
  double m_surfaceWork = 0;                             // by debris on what they hit, elements too [J]
  double m_given = 0;                                   // of the fracture energy, to debris [J]
  double m_impulseSizes = 0;                            // sum of |impulse| on debris [N s]
  double m_exchangedSize = 0;                           // sum of all |impulse| up to the last close [N s]
  double m_largestMomentum = 0, m_largestExchange = 0;  // in the world; in one tick [N s]
  double m_largestEnergy = 0;                           // [J]
  double m_lostByElements = 0;                          // [J]
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
