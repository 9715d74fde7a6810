// Elements against the rigid bodies of the host world. The bodies are sub-stepped copies (RigidProxy), so
// that a fast one is swept through the substeps and does not tunnel.
#pragma once

#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "edem/pair_lists.h"
#include "edem/rigid_proxy.h"
#include "edem/stable_step.h"
#include "edem/stages.h"

namespace rubble::edem {

template <class Real>
class RigidContacts {
 public:
  using Bodies = std::span<const std::unique_ptr<Body<Real>>>;

  /// Takes the proxies of a new tick; what contacts remember stays.
  void beginTick(std::span<RigidProxy> proxies, Books& books);
  /// Lists the elements within r + skin of each proxy. Holds until elements or proxies moved half the skin.
  void build(Bodies bodies, const PairLists<Real>& lists);
  /// True when a proxy has moved more than half the skin since build.
  bool expired(double skin) const;

  /// Visits visit(body, element, law, touching) for every candidate.
  template <class Visit>
  void visitRates(Visit&& visit) const {
    for (const Candidate& c : m_candidates)
      visit(c.body, c.element, m_states[c.proxy].laws[c.body], c.touching);
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
  void accumulate(Bodies bodies, const Steps& steps, double kick, Books& books);
  /// Takes the contacts of leaving elements out of this substep.
  void release(Bodies bodies, double step, double kick, Books& books);
  /// Moves the proxies (symplectic Euler) and books what passed between them and the elements.
  void integrate(Bodies bodies, double kick, double step, Books& books);
  /// Energy in the contacts [J].
  double elastic() const { return m_elastic; }

  /// Largest speed of a dynamic proxy's surface [m/s].
  double maxSpeed() const;

 private:
  struct Candidate {
    std::uint32_t proxy, body, element;
    bool touching = false;
    ContactMemory<double> memory;
    double energy = 0;  // at the last instant [J]
  };
  // A contact that outlives the lists.
  struct Kept {
    std::uint64_t key;
    std::uint32_t body, element;  // id of the body
    ContactMemory<double> memory;
    double energy;
    bool touching;
    bool taken = false;
    auto name() const { return std::tie(key, body, element); }
  };
  struct ProxyState {
    std::uint64_t key = 0;
    // Where the last tick left it; then, how far the host has moved it since.
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  // rotation vector [rad]
    bool shifted = false;
    // On the rigid body in this substep, and the part of it that is lost energy [N], [N m].
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    Eigen::Vector3d dampingForce = Eigen::Vector3d::Zero(), dampingTorque = Eigen::Vector3d::Zero();
    double size = 0;     // sum of |force| [N]
    double pressed = 0;  // the same in the last substep [N]
    Eigen::Vector3d listedPosition;
    Eigen::Quaterniond listedOrientation;
    double surplusNext = 0;                // second half step of RigidProxy::surplus [J]
    double mobility = 0;                   // sum over candidates of speed / impulse [1/kg]
    double rate = 0;                       // the same, times the stiffness of each [1/s^2]
    ElementRates rates;                    // of the rigid body, all candidates touching
    std::vector<ContactLaw<double>> laws;  // by body
  };
  struct Push {
    std::uint32_t proxy, body, element;
    Eigen::Vector3d force, torque;  // on the element
    double before = 0;              // power on it, by its velocity before the substep [W]
  };
  struct Touch {
    Eigen::Vector3d at;                           // contact point, world [m]
    Eigen::Vector3d x;                            // centre of the element [m]
    Eigen::Vector3d force, torque;                // on the element, in its own scalar
    Eigen::Vector3d dampingForce, dampingTorque;  // their lost part
    double energy = 0, slipped = 0, power = 0;
  };

  void keepContacts();
  void bookShift(const ProxyState& state, RigidProxy& proxy, Books& books) const;
  double pushPower(const Push& push, const Body<Real>& body) const;
  void endContacts(Bodies bodies);
  void listNear(std::uint32_t proxy, std::uint32_t place, const Body<Real>& body,
                const PairLists<Real>& lists);
  void remember(Candidate& candidate);
  void weigh(Bodies bodies);
  bool touch(Candidate& candidate, const Body<Real>& body, const Steps& steps, Touch& out) const;
  void add(const Touch& touch, const Candidate& candidate, Body<Real>& body, double sign);

  std::span<RigidProxy> m_proxies;
  std::vector<ProxyState> m_states, m_before;  // of this tick, of the last
  std::vector<Candidate> m_candidates;         // rising in (proxy, body, element)
  std::vector<std::uint32_t> m_ids;            // of the bodies, by place, at the last build
  std::vector<Kept> m_kept;                    // between two lists, and while their body sleeps
  std::vector<ContactSide> m_sides;            // of the bodies, by place
  std::vector<Push> m_pushes;                  // on elements, in this substep
  double m_elastic = 0;
  double m_lost = 0;  // energy of contacts that ended between two substeps [J]
};

extern template class RigidContacts<float>;
extern template class RigidContacts<double>;

}  // namespace rubble::edem
