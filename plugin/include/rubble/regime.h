// Who moves a body: its elements or the host.
#pragma once

namespace rubble {

/// Who moves a body that nothing strikes.
enum class Regime {
  Elements,  ///< its elements, from the start and for ever: the reference, and the paper's letter
  /// The default. Bullet, as one rigid body of true mass and shape: it rests, stacks, sleeps and takes forces
  /// as any other does. The elements take over in the very tick in which something is about to strike it with
  /// a stress of half its tensile strength, with both momenta. If it does not break and is calm for a quarter
  /// of a second (slow, without tremor, no spring stressed to half its strength), it is Bullet's again: in
  /// the shape it had, with both momenta and the application's settings, until it is struck the next time.
  /// One that has come apart stays elements. Loads that rest on it, its own weight if it is anchored
  /// included, hand it to its elements too, where beam theory finds half its strength. A solid that is not
  /// convex is a compound of convex parts, at most 10 % larger. One for which those would be too many, or
  /// that is not in one piece, is elements from the start, and so is one whose anchors hold to a body:
  /// LogLevel::Info says so.
  RigidUntilStruck,
};

}  // namespace rubble
