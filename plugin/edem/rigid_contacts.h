// Elements against the rigid bodies of the host world. The bodies are sub-stepped copies (RigidProxy), so
// that a fast one is swept through the substeps and does not tunnel.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "edem/drift.h"
#include "edem/pair_lists.h"
#include "edem/rigid_rates.h"
#include "edem/rigid_touch.h"
#include "edem/stages.h"

namespace rubble::edem {

template <class Real>
class RigidContacts {
 public:
  using Bodies = std::span<const std::unique_ptr<Body<Real>>>;

  /// Takes the proxies of a new tick; what contacts remember stays.
  void beginTick(std::span<RigidProxy> proxies);
  /// Lists the elements within their reach + skin of each proxy. Holds until elements or proxies moved half
  /// the skin.
  void build(Bodies bodies, const PairLists<Real>& lists);
  /// True when a proxy has moved more than half the skin since build, beside its drift.
  bool expired(double skin, std::span<const Drift> drifts) const;

  /// Takes faces that broke since the last call into the rates.
  void weigh(Bodies bodies);
  /// Visits visit(body, element, rates, touching, frequency2) for every candidate; frequency2 is that of the
  /// contact alone [1/s^2].
  template <class Visit>
  void visitRates(Bodies bodies, Visit&& visit) const {
    for (const RigidContact& c : m_contacts) {
      double frequency2 = 0;
      const ElementRates rates = ratesOf(c, *bodies[c.body], m_states[c.proxy].laws[c.body], frequency2);
      visit(c.body, c.element, rates, c.touching, frequency2);
    }
  }
  /// Makes the contacts of light bodies softer, so that no rate of theirs passes a multiple of
  /// `frequency2`, that of the elements [1/s^2].
  void soften(double frequency2);
  /// Visits visit(body, element, rates of the rigid body) for every candidate at a dynamic body.
  template <class Visit>
  void visitProxyRates(Visit&& visit) const {
    for (const RigidContact& c : m_contacts)
      if (m_proxies[c.proxy].isDynamic()) visit(c.body, c.element, m_states[c.proxy].rates);
  }

  /// Contact forces on elements and proxies (paper 3.1.2, "interaction with other objects").
  void accumulate(Bodies bodies, const Steps& steps, double kick, RestingLoads& resting, Books& books);
  /// Takes the contacts of leaving elements out of this substep.
  void release(Bodies bodies, double kick, Books& books);
  /// Touches anew, in this substep, what breaks have exposed more of; once they are applied.
  void expose(Bodies bodies, double step, double kick, RestingLoads& resting, Books& books);
  /// Ends all contacts of a body, between two ticks. Returns the energy that was in them [J].
  double endContactsOf(std::uint32_t id);
  /// Moves the proxies (symplectic Euler) and books what passed between them and the elements.
  void integrate(Bodies bodies, double kick, double step, Books& books);
  /// Furthest that the cells of a body, by its place, and a rigid body are in each other [m].
  double overlapOf(std::size_t place) const;
  /// Energy in the contacts [J].
  double elastic() const { return m_elastic; }

  using VisitElement = std::function<void(std::uint32_t body, std::uint32_t element)>;
  /// Visits the places of sleeping elements that a proxy which is not still has come near to since the lists
  /// of pairs were built, or that touched one which is no longer there.
  void visitDisturbed(Bodies bodies, const PairLists<Real>& lists, const VisitElement& visit) const;
  /// Visits those of elements that touch a proxy which is not still.
  void visitAtMoving(const VisitElement& visit) const;

  /// Largest speed of a proxy's surface beside its drift [m/s].
  double maxSpeed(std::span<const Drift> drifts) const;
  /// Shortest time in which a sphere that moves at `speed` is through a rigid body that it is near [s].
  double shortestPass(Bodies bodies, std::span<const Drift> drifts, double speed) const;
  std::span<const RigidProxy> proxies() const { return m_proxies; }

 private:
  // A contact that outlives the lists.
  struct Kept {
    std::uint64_t key;
    std::uint32_t body, element;  // id of the body
    ContactMemory<double> memory;
    FaceMemory faces;
    bool touching;
    bool taken = false;
    auto name() const { return std::tie(key, body, element); }
  };
  // What a contact does in this substep.
  struct Push {
    std::uint32_t proxy, body, element;
    RigidTouch touch;
    double before = 0;  // power on the element, by its velocity before the substep [W]
  };

  void keepContacts();
  double pushPower(const Push& push, const Body<Real>& body) const;
  void endContacts(Bodies bodies);
  static double away(const PairLists<Real>& lists);
  /// visit(element, its centre [m], its distance from the proxy's surface [m]) for those that sleep, or for
  /// those that do not, near enough to be listed.
  template <class Visit>
  void visitNear(std::uint32_t proxy, std::uint32_t place, const Body<Real>& body, bool sleeping,
                 const PairLists<Real>& lists, Visit&& visit) const;
  void listNear(std::uint32_t proxy, std::uint32_t place, const Body<Real>& body,
                const PairLists<Real>& lists);
  void remember(RigidContact& contact);
  std::uint32_t placeOf(const RigidContact& contact) const {
    return std::uint32_t(&contact - m_contacts.data());
  }
  void findAllCorners(Bodies bodies);
  void findAllCorners(Bodies bodies, CornerHits& corners);
  bool isListed(std::uint32_t proxy, const CornerMemory& corner, Bodies bodies) const;
  bool touch(RigidContact& contact, const Body<Real>& body, const CornerHits& corners, const Steps& steps,
             RestingLoads& resting, RigidTouch& out);
  bool touchMoved(RigidContact& contact, const Body<Real>& body, const Steps& steps, double kick,
                  RestingLoads& resting, Books& books, RigidTouch& out);
  void add(const RigidTouch& touch, RigidContact& contact, Body<Real>& body);
  void take(RigidContact& contact, Body<Real>& body);
  void apply(const Push& push, Body<Real>& body, double sign);
  static void bookChange(const RigidTouch& before, const RigidTouch& now, double kick, Books& books);

  std::span<RigidProxy> m_proxies;
  std::vector<RigidState> m_states, m_before;  // of this tick, of the last
  std::vector<RigidContact> m_contacts;        // rising in (proxy, body, element)
  std::vector<std::uint32_t> m_ids;            // of the bodies, by place, at the last build
  std::vector<Kept> m_kept;                    // between two lists, and while their body sleeps
  std::vector<ContactSide> m_sides;            // of the bodies, by place
  std::vector<Push> m_pushes;                  // on elements, in this substep
  FaceTouch m_faces;
  CornerHits m_corners, m_cornersLeft;  // where the proxies are, and where the last substep left them
  double m_moved = 0;                   // length of the step before the last accumulate [s]
  double m_elastic = 0;
  double m_lost = 0;  // energy of contacts that ended between two substeps [J]
};

extern template class RigidContacts<float>;
extern template class RigidContacts<double>;

}  // namespace rubble::edem
