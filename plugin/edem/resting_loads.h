// What contacts carry while nothing moves: the loads by gravity and the application's forces, passed on from
// body to body. Restitution withholds what a blow has stored in a contact but not these, or a weight that
// turns back on a springy block would let go of it at once. Loads are of fragments and rigid bodies that
// touch, all contacts of two of them together, in balance of forces alone: levers are left out.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace rubble::edem {

/// A fragment or a rigid body that may carry or be carried.
struct LoadedThing {
  std::uint64_t name;        ///< one of fragmentName, rigidName
  double inverseMass;        ///< 0: does not move [1/kg]
  Eigen::Vector3d external;  ///< acceleration by gravity and the application [m/s^2]
};

/// Name of the fragment of body `body` whose lowest element is `lowest`.
constexpr std::uint64_t fragmentName(std::uint32_t body, std::uint32_t lowest) {
  return std::uint64_t(body) << 32 | lowest;
}
/// Name of the rigid body with the proxy key `key`.
constexpr std::uint64_t rigidName(std::uint64_t key) {
  return std::uint64_t(1) << 63 | key;
}

class RestingLoads {
 public:
  /// Forgets what no longer touches. Call once a tick.
  void beginTick(const Eigen::Vector3d& gravity);
  const Eigen::Vector3d& gravity() const { return m_gravity; }
  /// A thing has another name, which none has had.
  void rename(std::uint64_t from, std::uint64_t to);
  /// The pair of two things, new or known. Of two fragments the one of the lesser name is the first; rigid
  /// bodies come before fragments.
  std::size_t pairOf(const LoadedThing& first, const LoadedThing& second);
  /// Share of the contacts' force of a pair that rests, as of the last substep, 0 to 1.
  double share(std::size_t pair) const { return m_pairs[pair].share; }
  /// A contact of the pair presses the second thing with the force `pushed` before any is withheld [N].
  void push(std::size_t pair, const Eigen::Vector3d& pushed) { m_pairs[pair].pushed += pushed; }
  /// Once all contacts of a substep have pushed: brings the loads nearer to balance.
  void settle();

 private:
  struct Node {
    LoadedThing thing;
    Eigen::Vector3d acceleration;  // by all loads [m/s^2]
  };
  struct Pair {
    std::size_t first, second;                          // into m_nodes
    Eigen::Vector3d pushed = Eigen::Vector3d::Zero();   // on the second in this substep [N]
    Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // of it
    double load = 0;                                    // at rest [N]
    double share = 0;
  };
  using Name = std::pair<std::uint64_t, std::uint64_t>;
  struct Hash {
    std::size_t operator()(const Name& name) const;
  };

  std::size_t nodeOf(const LoadedThing& thing);
  void sweep();
  void accelerate(const Pair& pair, double load);

  Eigen::Vector3d m_gravity = Eigen::Vector3d::Zero();
  std::vector<Node> m_nodes;
  std::vector<Pair> m_pairs;
  std::unordered_map<std::uint64_t, std::size_t> m_nodeOf;
  std::unordered_map<Name, std::size_t, Hash> m_pairOf;
};

}  // namespace rubble::edem
