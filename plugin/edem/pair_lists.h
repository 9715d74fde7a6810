// Which elements may touch: candidate pairs within a body and between bodies, by a uniform grid (paper 4.1)
// with a skin, so that they last several substeps. This is the plain reference; faster lists must give the
// same contacts.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "edem/body.h"
#include "edem/grid.h"

namespace rubble::edem {

struct PairEntry {
  std::uint32_t first;    ///< in the first body
  std::uint32_t second;   ///< in the second body
  std::uint32_t pair;     ///< into BodyState::range, or kNoPair
  bool touching = false;  ///< at the last instant; the pair then has a memory
};

/// Candidates between two bodies, or within one (first == second). Rising in (first, second): sums do not
/// depend on how they were found.
template <class Real>
struct PairList {
  std::uint32_t first, second;      ///< places in the solver's list of bodies
  std::uint32_t firstId, secondId;  ///< of the bodies
  ContactLaw<Real> law;
  std::vector<PairEntry> entries;
  std::vector<ContactMemory<Real>> memory;  ///< beside `entries`; zero where they do not touch
  std::vector<std::uint32_t> awake;         ///< those of which not both elements sleep, in rising order
  double elasticAsleep = 0;                 ///< energy of the contacts of the others [J]
  double elastic = 0;                       ///< energy of the contacts at the last instant [J]
};

/// Per body: the grid over its elements at the last listing.
struct ElementGrid {
  Grid<double> grid;
  std::vector<Vec3<double>> listed;  ///< positions at the last listing, relative to the body's origin [m]
  Eigen::AlignedBox3d bounds;        ///< of the listed centres, world [m]
  /// Of a body that slept as a whole: whose, and when; it holds until that wakes.
  std::uint32_t sleeper = kNoPair;
  std::uint64_t sleepChanges = 0;
};

template <class Real>
class PairLists {
 public:
  /// Lists anew. `skin` is added to the contact distance; the lists hold until an element moved half of it
  /// [m]. Pairs that touched keep their memory; lists of bodies that sleep stay as they are.
  void build(std::span<const std::unique_ptr<Body<Real>>> bodies, double skin);
  /// Some elements woke since.
  void listAwake(std::span<const std::unique_ptr<Body<Real>>> bodies);
  /// A spring broke: its pair may touch from now on.
  void addBroken(std::uint32_t body, const PairEntry& entry);
  /// The body at `place` has been taken out of the solver's list: its pairs are forgotten.
  void removeBody(std::uint32_t place);
  /// One has been put there, which touches nothing yet.
  void insertBody(std::uint32_t place, std::uint32_t id);

  /// Elements marked in `which` of the body at `place` have become `part`, at `partPlace` behind all others:
  /// takes their pairs along, those that touch what stays or others as well.
  void split(std::uint32_t place, std::span<const std::uint8_t> which, const Body<Real>& part,
             std::uint32_t partPlace);

  /// Makes all contacts as stiff as `share` of what their bodies ask for, until told otherwise.
  void soften(std::span<const std::unique_ptr<Body<Real>>> bodies, double share);
  /// Energy in the contacts of what is awake [J].
  double elasticAwake() const;

  /// Ends all contacts of a body that stays in the list. Returns the energy that was in them [J].
  double endContactsOf(std::uint32_t id);

  std::span<PairList<Real>> lists() { return m_lists; }
  std::span<const PairList<Real>> lists() const { return m_lists; }
  const ElementGrid& grid(std::size_t body) const { return m_grids[body]; }
  double skin() const { return m_skin; }

 private:
  void grid(const Body<Real>& body, ElementGrid& out) const;
  PairList<Real> take(const Body<Real>& a, const Body<Real>& b, std::uint32_t placeA, std::uint32_t placeB);
  ContactLaw<Real> lawOf(const Body<Real>& a, const Body<Real>& b) const;
  void listWithin(const Body<Real>& body, std::uint32_t place, PairList<Real>& list);
  void listBetween(const Body<Real>& a, const Body<Real>& b, PairList<Real>& list);

  double m_skin = 0;
  double m_share = 1;  // of the stiffness that bodies ask for
  std::vector<ElementGrid> m_grids;
  std::vector<PairList<Real>> m_lists;  // m_lists[place] is within body `place`; those between bodies behind
  std::vector<PairList<Real>> m_old;    // of the last build
};

extern template class PairLists<float>;
extern template class PairLists<double>;

}  // namespace rubble::edem
