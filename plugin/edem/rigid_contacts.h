// Elements against the rigid bodies of the host world. The bodies are sub-stepped copies (RigidProxy), so
// that a fast one is swept through the substeps and does not tunnel.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "edem/pair_lists.h"
#include "edem/rigid_proxy.h"
#include "edem/stages.h"

namespace rubble::edem {

template <class Real>
class RigidContacts {
 public:
  /// Forgets the candidates and remembers the proxies of a new tick.
  void beginTick(std::span<RigidProxy> proxies);
  /// Lists the elements within r + skin of each proxy. Holds until elements or proxies moved half the skin.
  void build(std::span<const std::unique_ptr<Body<Real>>> bodies, const PairLists<Real>& lists);
  /// True when a proxy has moved more than half the skin since build.
  bool expired(double skin) const;

  /// Contact forces on elements and proxies (paper 3.1.2, "interaction with other objects"); books impulses
  /// and the first half of the work.
  void accumulate(std::span<const std::unique_ptr<Body<Real>>> bodies, double kick, Books& books);
  /// Second half of the work, once the elements have their new velocities.
  void bookSecondHalf(std::span<const std::unique_ptr<Body<Real>>> bodies, double kick, Books& books) const;
  /// Moves the proxies (symplectic Euler).
  void integrate(double kick, double step);

  /// Adds the stiffness and damping of present and near contacts, per element of body `place`.
  void addRates(const Body<Real>& body, std::uint32_t place, double step,
                std::span<struct ElementRates> rates) const;
  /// Largest speed of a dynamic proxy's surface [m/s].
  double maxSpeed() const;

 private:
  struct Candidate {
    std::uint32_t proxy, body, element;
  };
  struct Touch {
    std::uint32_t body, element;
    Eigen::Vector3d force, torque;  // on the element
  };
  struct ProxyState {
    Eigen::Vector3d force, torque;  // on the rigid body in this substep
    Eigen::Vector3d listedPosition;
    Eigen::Quaterniond listedOrientation;
  };

  double contactStiffness(const RigidProxy& proxy, const Body<Real>& body, double step) const;
  bool touch(RigidProxy& proxy, Body<Real>& body, std::uint32_t element, double kick, Touch& out,
             Eigen::Vector3d& at) const;

  std::span<RigidProxy> m_proxies;
  std::vector<ProxyState> m_states;
  std::vector<Candidate> m_candidates;
  std::vector<Touch> m_touches;
};

extern template class RigidContacts<float>;
extern template class RigidContacts<double>;

}  // namespace rubble::edem
