// Elements against the rigid bodies of the host world. The bodies are sub-stepped copies (RigidProxy), so
// that a fast one is swept through the substeps and does not tunnel.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "edem/rigid_lists.h"
#include "edem/rigid_rates.h"
#include "edem/rigid_touch.h"
#include "edem/stages.h"

namespace rubble::edem {

template <class Real>
class RigidContacts {
 public:
  using Bodies = std::span<const std::unique_ptr<Body<Real>>>;

  /// Takes the proxies of a new tick; what contacts remember stays, but for those at proxies that the
  /// application has put further away than `leap` [m]. Of bodies lighter than `light` [kg] see takeProxies.
  void beginTick(std::span<RigidProxy> proxies, double leap, double light);
  /// Elements marked in `which` of a body have become another, between two ticks: what is remembered of them
  /// goes along.
  void split(std::uint32_t id, std::span<const std::uint8_t> which, std::uint32_t newId);
  /// Lists the elements within their reach + skin of each proxy. Holds until elements or proxies moved half
  /// the skin.
  void build(Bodies bodies, const PairLists<Real>& lists);
  /// True when a proxy has moved more than half the skin since build, beside its drift.
  bool expired(double skin, std::span<const Drift> drifts) const {
    return m_lists.expired(skin, drifts, m_proxies, m_states);
  }

  /// Takes faces that broke since the last call into the rates.
  void weigh(Bodies bodies);
  /// Visits visit(body, element, rates, touching, frequency2) for every candidate; frequency2 is that of the
  /// contact alone [1/s^2].
  template <class Visit>
  void visitRates(Bodies bodies, Visit&& visit) const {
    for (const RigidContact& c : m_lists.contacts()) {
      double frequency2 = 0;
      const ElementRates rates = ratesOf(c, *bodies[c.body], m_states[c.proxy].laws[c.body], frequency2);
      visit(c.body, c.element, rates, c.touching, frequency2);
    }
  }
  /// Makes the contacts of light bodies softer, so that no rate of theirs passes a multiple of
  /// `frequency2`, that of the elements [1/s^2].
  void soften(double frequency2);
  /// Makes all contacts as stiff as `share` of what their bodies ask for, until told otherwise.
  void setShare(double share);
  /// Energy in the contacts of what is awake [J].
  double elasticAwake() const;
  /// Visits visit(body, element, proxy, rates of the rigid body) for every candidate at a dynamic body.
  template <class Visit>
  void visitProxyRates(Visit&& visit) const {
    for (const RigidContact& c : m_lists.contacts())
      if (m_proxies[c.proxy].isDynamic()) visit(c.body, c.element, c.proxy, m_states[c.proxy].rates);
  }

  /// Contact forces on elements and proxies (paper 3.1.2, "interaction with other objects").
  void accumulate(Bodies bodies, const Steps& steps, double kick, RestingLoads& resting, Books& books);
  /// Takes the contacts of leaving elements out of this substep.
  void release(Bodies bodies, double kick, Books& books);
  /// Touches anew, in this substep, what breaks have exposed more of; once they are applied.
  void expose(Bodies bodies, double step, double kick, RestingLoads& resting, Books& books);
  /// Ends all contacts of a body, between two ticks. Returns the energy that was in them [J].
  double endContactsOf(std::uint32_t id);
  /// Adds what anchors do to a proxy in this substep, about its centre of mass, and the part of it that is
  /// lost energy [N], [N m].
  void pull(std::uint32_t proxy, const Wrench& all, const Wrench& damping);
  /// Gives a proxy an impulse and one of rotation about its centre, after the substeps [N s], [N m s].
  void push(std::uint32_t proxy, const Wrench& impulse);
  /// What all contacts of a proxy are as fast as, if they touch.
  const ElementRates& proxyRates(std::uint32_t proxy) const { return m_states[proxy].rates; }
  /// Moves the proxies (symplectic Euler) and books what passed between them and the elements.
  void integrate(Bodies bodies, double kick, double step, Books& books);
  /// Furthest that the cells of a body, by its id, and a rigid body are in each other [m].
  double overlapOf(std::uint32_t id) const;
  /// Energy in the contacts [J].
  double elastic() const { return m_elastic; }

  using VisitElement = typename RigidLists<Real>::VisitElement;
  /// See RigidLists.
  void visitDisturbed(Bodies bodies, const PairLists<Real>& lists, const VisitElement& visit) const {
    m_lists.visitDisturbed(bodies, lists, m_proxies, m_states, visit);
  }
  void visitAtMoving(const VisitElement& visit) const { m_lists.visitAtMoving(m_states, visit); }

  /// Largest speed of a proxy's surface beside its drift [m/s].
  double maxSpeed(std::span<const Drift> drifts) const;
  /// Highest frequency^2 of a rigid body on what presses it and on what may begin to, of those that come fast
  /// enough for a blow [1/s^2].
  double blowFrequency2(Bodies bodies, std::span<const Drift> drifts);
  /// Whether more presses one of them since than that was for.
  bool blowGrew() const;
  /// Shortest time in which a sphere that moves at `speed` is through a rigid body that it is near [s].
  double shortestPass(Bodies bodies, std::span<const Drift> drifts, double speed) const;
  std::span<const RigidProxy> proxies() const { return m_proxies; }

 private:
  // What a contact does in this substep.
  struct Push {
    std::uint32_t proxy, body, element;
    RigidTouch touch;
    double before = 0;  // power on the element, by its velocity before the substep [W]
  };

  double pushPower(const Push& push, const Body<Real>& body) const;
  void findAllCorners(Bodies bodies);
  void findAllCorners(Bodies bodies, CornerHits& corners);
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
  RigidLists<Real> m_lists;
  std::vector<ContactSide> m_sides;  // of the bodies, by place
  std::vector<Push> m_pushes;        // on elements, in this substep
  FaceTouch m_faces;
  CornerHits m_corners, m_cornersLeft;  // where the proxies are, and where the last substep left them
  double m_moved = 0;                   // length of the step before the last accumulate [s]
  double m_elastic = 0;
  double m_blow2 = 0;  // what blowFrequency2 was last
  double m_share = 1;  // of the stiffness that bodies ask for
};

extern template class RigidContacts<float>;
extern template class RigidContacts<double>;

}  // namespace rubble::edem
