// What a static solve gives, and its cache: equal bodies are solved once. A state can also be kept in the
// asset (AssetRest), and so in its file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "edem/types.h"
#include "rubble/asset.h"
#include "rubble/material.h"

namespace rubble::edem {

enum class PrestressOutcome {
  Done,
  Cached,       ///< an equal body's state was taken
  Kept,         ///< the state kept in the asset was taken
  NotNeeded,    ///< not asked for an anchored body, or there is no gravity
  NotAnchored,  ///< a part of the body, or all of it, hangs on no anchor: it has no static state of its own
  Failed        ///< nothing was written; `reason` says why
};

struct PrestressResult {
  PrestressOutcome outcome = PrestressOutcome::NotNeeded;
  std::string reason;  ///< of NotAnchored and Failed: one clause about "it", the body
  /// Largest remaining force over the weight of an element, or torque over weight times radius,
  /// dimensionless.
  double residual = 0;
  int corrections = 0;  ///< solutions with the stiffness at rest
  int iterations = 0;   ///< of conjugate gradients, in all of them; 0 after a sparse Cholesky
  /// Why the state kept in the asset was not taken: one clause about "it", the state. Empty if it was, or if
  /// none was asked for.
  std::string refusal;

  bool applied() const {
    return outcome == PrestressOutcome::Done || outcome == PrestressOutcome::Cached ||
           outcome == PrestressOutcome::Kept;
  }
};

/// What a body's static state depends on, beside its asset. Compared bit by bit.
struct StaticRestKey {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< asset axes [m/s^2]
  double youngsModulus = 0;                           ///< [Pa]
  double density = 0;                                 ///< [kg/m^3]
  bool rotationalStiffness = true;
  Precision precision = Precision::Float;  ///< of the springs' constants
};

/// AssetRest::key: FNV-1a over the bits of the key and of the asset's elements, springs and anchors. Inputs
/// alone, nothing computed from them, so that compilers that round otherwise make the same.
std::uint64_t hashOf(const StaticRestKey& key, const Asset& asset);

/// States by asset and key, for as long as the asset lives. Failures are kept too, without a state.
class StaticRestCache {
 public:
  struct Entry {
    std::weak_ptr<const Asset> asset;
    StaticRestKey key;
    AssetRest rest;  ///< without its key
    PrestressResult result;
  };
  /// The entry, or null. Valid until the next call of add.
  const Entry* find(const std::shared_ptr<const Asset>& asset, const StaticRestKey& key) const;
  /// Keeps a new entry; forgets those whose asset is gone.
  void add(Entry entry);
  std::size_t size() const { return m_entries.size(); }

 private:
  std::vector<Entry> m_entries;
};

}  // namespace rubble::edem
