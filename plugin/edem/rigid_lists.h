// Which elements are near which rigid bodies, and what their contacts remember from one list to the next.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "edem/drift.h"
#include "edem/pair_lists.h"
#include "edem/rigid_contact.h"
#include "edem/rigid_proxy.h"

namespace rubble::edem {

template <class Real>
class RigidLists {
 public:
  using Bodies = std::span<const std::unique_ptr<Body<Real>>>;

  /// Ends the lists; what contacts remember stays until the next.
  void keep(std::span<const RigidState> states);
  /// Lists the elements within their reach + skin of each proxy, and notes in the states where that was.
  /// Holds until elements or proxies moved half the skin.
  void build(Bodies bodies, const PairLists<Real>& lists, std::span<const RigidProxy> proxies,
             std::span<RigidState> states);
  /// True when a proxy has moved more than half the skin since build, beside its drift.
  bool expired(double skin, std::span<const Drift> drifts, std::span<const RigidProxy> proxies,
               std::span<const RigidState> states) const;

  /// Rising in (proxy, body, element).
  std::vector<RigidContact>& contacts() { return m_contacts; }
  const std::vector<RigidContact>& contacts() const { return m_contacts; }
  std::uint32_t placeOf(const RigidContact& contact) const {
    return std::uint32_t(&contact - m_contacts.data());
  }
  /// Of an element of the body with the id `id` at a proxy; null where it is not listed.
  const RigidContact* find(std::uint32_t proxy, std::uint32_t id, std::uint32_t element) const;
  /// Of the body of its element.
  std::uint32_t idOf(const RigidContact& contact) const { return m_ids[contact.body]; }

  /// Ends all contacts of a body, between two ticks. Returns the energy that was in them [J].
  double end(std::uint32_t id);
  /// Ends the lists and gives what is remembered of the elements marked in `which` to another body.
  void split(std::span<const RigidState> states, std::uint32_t id, std::span<const std::uint8_t> which,
             std::uint32_t newId);
  /// Ends what is remembered of contacts at a rigid body, once the lists have ended.
  void part(std::uint64_t key);
  /// In the contacts of what sleeps [J].
  double keptEnergy() const;
  /// That of contacts that have ended since the last call [J].
  double takeLost() { return std::exchange(m_lost, 0); }

  using VisitElement = std::function<void(std::uint32_t body, std::uint32_t element)>;
  /// Visits the places of sleeping elements that a proxy which is not still has come near to since the lists
  /// of pairs were built, or that touched one which is no longer there.
  void visitDisturbed(Bodies bodies, const PairLists<Real>& lists, std::span<const RigidProxy> proxies,
                      std::span<const RigidState> states, const VisitElement& visit) const;
  /// Visits those of elements that touch a proxy which is not still.
  void visitAtMoving(std::span<const RigidState> states, const VisitElement& visit) const;

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

  void remember(std::uint64_t key, RigidContact& contact);
  void endKept(Bodies bodies);
  static double away(const PairLists<Real>& lists);
  /// visit(element, its centre [m], its distance from the proxy's surface [m]) for those that sleep, or for
  /// those that do not, near enough to be listed.
  template <class Visit>
  void visitNear(const RigidProxy& proxy, std::uint32_t place, const Body<Real>& body, bool sleeping,
                 const PairLists<Real>& lists, Visit&& visit) const;
  void listNear(const RigidProxy& proxy, std::uint64_t key, std::uint32_t p, std::uint32_t place,
                const Body<Real>& body, const PairLists<Real>& lists);

  std::vector<RigidContact> m_contacts;
  std::vector<std::uint32_t> m_ids;  // of the bodies, by place, at the last build
  std::vector<Kept> m_kept;          // between two lists, and while their body sleeps
  double m_lost = 0;                 // energy of contacts that ended between two substeps [J]
};

extern template class RigidLists<float>;
extern template class RigidLists<double>;

}  // namespace rubble::edem
