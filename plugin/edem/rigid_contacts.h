// Elements against the rigid bodies of the host world. The bodies are sub-stepped copies (RigidProxy), so
// that a fast one is swept through the substeps and does not tunnel.
#pragma once

#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "edem/corner_hits.h"
#include "edem/drift.h"
#include "edem/face_touch.h"
#include "edem/pair_lists.h"
#include "edem/resting_loads.h"
#include "edem/rigid_proxy.h"
#include "edem/stable_step.h"
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
    for (const Candidate& c : m_candidates) {
      double frequency2 = 0;
      const ElementRates rates = ratesOf(c, *bodies[c.body], frequency2);
      visit(c.body, c.element, rates, c.touching, frequency2);
    }
  }
  /// Makes the contacts of light bodies softer, so that no rate of theirs passes a multiple of
  /// `frequency2`, that of the elements [1/s^2].
  void soften(double frequency2);
  /// Visits visit(body, element, rates of the rigid body) for every candidate at a dynamic body.
  template <class Visit>
  void visitProxyRates(Visit&& visit) const {
    for (const Candidate& c : m_candidates)
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

  /// Largest speed of a proxy's surface beside its drift [m/s].
  double maxSpeed(std::span<const Drift> drifts) const;
  std::span<const RigidProxy> proxies() const { return m_proxies; }

 private:
  // What faces remember of a rigid body beside their contact's memory.
  struct FaceMemory {
    double deepest = 0;  // at the last instant, but for its corners; 0: out of it [m]
    double sunk = 0;     // depth without force: they were first seen as deep [m]
    double area = 0;     // exposed at the last instant [m^2]
  };
  // A corner of a rigid body that is in an element.
  struct CornerMemory {
    CornerName name;
    std::uint32_t body, element;  // id of the body
    double pressed;               // depth with force [m]
    double sunk;                  // depth without: it was first seen as deep [m]
  };
  struct Candidate {
    std::uint32_t proxy, body, element;
    bool touching = false;
    ContactMemory<double> memory;
    double energy = 0;  // at the last instant [J]
    FaceMemory faces;
    double weight = 0;         // sum of all that may press at once, over k_n
    double mode = 0;           // its highest frequency^2, over k_n / m
    double dampingWeight = 0;  // the same for its dashpots, over eta_n / m
    double lone = 0;           // the weight of what acts at once, without levers
    double balls = 0;          // weights of corners and spheres near
    bool core = false;         // near
    std::uint32_t push = 0;    // while touching: into m_pushes
    double exposed = 0;        // area of exposed faces when the weights were taken [m^2]
  };
  // A contact that outlives the lists.
  struct Kept {
    std::uint64_t key;
    std::uint32_t body, element;  // id of the body
    ContactMemory<double> memory;
    double energy;
    FaceMemory faces;
    bool touching;
    bool taken = false;
    auto name() const { return std::tie(key, body, element); }
  };
  struct Motion {
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  };
  struct ProxyState {
    std::uint64_t key = 0;
    Motion left;         // when the last substep was over
    bool moved = false;  // by the host since
    // On the rigid body in this substep, and the part of it that is lost energy [N], [N m].
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    Eigen::Vector3d dampingForce = Eigen::Vector3d::Zero(), dampingTorque = Eigen::Vector3d::Zero();
    double size = 0;     // sum of |force| [N]
    double pressed = 0;  // the same in the last substep [N]
    Eigen::Vector3d listedPosition;
    Eigen::Quaterniond listedOrientation;
    double surplusNext = 0;                            // second half step of RigidProxy::surplus [J]
    double mobility = 0;                               // sum over candidates of speed / impulse [1/kg]
    double rate = 0;                                   // the same, times the stiffness of each [1/s^2]
    ElementRates rates;                                // of the rigid body, all candidates touching
    std::vector<ContactLaw<double>> laws;              // by body
    std::vector<CornerMemory> corners, cornersBefore;  // at this instant, at the last
  };
  struct Touch {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();  // contact point, world [m]
    Eigen::Vector3d x = Eigen::Vector3d::Zero();   // centre of the element [m]
    // On the element, in its own scalar, and their lost part.
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    Eigen::Vector3d dampingForce = Eigen::Vector3d::Zero(), dampingTorque = Eigen::Vector3d::Zero();
    double energy = 0, slipped = 0, power = 0;
    Eigen::Vector3d full = Eigen::Vector3d::Zero();  // normal force on it before any is withheld [N]
    std::size_t resting = 0;                         // place among the resting loads
  };
  // What a contact does in this substep.
  struct Push {
    std::uint32_t proxy, body, element;
    Touch touch;
    double before = 0;  // power on the element, by its velocity before the substep [W]
  };

  void keepContacts();
  double pushPower(const Push& push, const Body<Real>& body) const;
  void endContacts(Bodies bodies);
  void listNear(std::uint32_t proxy, std::uint32_t place, const Body<Real>& body,
                const PairLists<Real>& lists);
  void remember(Candidate& candidate);
  void weighFaces(Candidate& candidate, const Body<Real>& body);
  ElementRates ratesOf(const Candidate& candidate, const Body<Real>& body, double& frequency2) const;
  bool touchFaces(Candidate& candidate, const Body<Real>& body, const CornerHits& corners, const Steps& steps,
                  RestingLoads& resting, Touch& out);
  std::uint32_t placeOf(const Candidate& candidate) const {
    return std::uint32_t(&candidate - m_candidates.data());
  }
  void findCorners(Bodies bodies);
  void findCorners(Bodies bodies, CornerHits& corners);
  void cornersOf(const Candidate& candidate, const Body<Real>& body);
  void sink(Candidate& candidate, const Body<Real>& body, const CornerHits& corners,
            const ElementMotion& motion, double moved);
  static double sinkCorner(ProxyState& state, CornerMemory corner, double way, double nearer);
  static void finish(const ContactMotion<double>& motion, const ContactLoad<double>& load, Touch& out);
  double joltOf(const FragmentMotion& fragment, std::uint32_t proxy, double step) const;
  bool touch(Candidate& candidate, const Body<Real>& body, const CornerHits& corners, const Steps& steps,
             RestingLoads& resting, Touch& out);
  std::size_t restingOf(const Candidate& candidate, const Body<Real>& body, RestingLoads& resting) const;
  bool touchMoved(Candidate& candidate, const Body<Real>& body, const Steps& steps, double kick,
                  RestingLoads& resting, Books& books, Touch& out);
  static Motion motionOf(const RigidProxy& proxy);
  static void setMotion(RigidProxy& proxy, const Motion& motion);
  void add(const Touch& touch, Candidate& candidate, Body<Real>& body);
  void take(Candidate& candidate, Body<Real>& body);
  void apply(const Push& push, Body<Real>& body, double sign);
  static void bookChange(const Touch& before, const Touch& now, double kick, Books& books);

  std::span<RigidProxy> m_proxies;
  std::vector<ProxyState> m_states, m_before;  // of this tick, of the last
  std::vector<Candidate> m_candidates;         // rising in (proxy, body, element)
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
