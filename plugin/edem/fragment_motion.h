// The rigid motion of each fragment through a tick, for the restitution of its contacts. What holds a
// fragment together moves neither its momentum nor its spin, so that these follow from the contacts and
// gravity alone.
#pragma once

#include "edem/body.h"

namespace rubble::edem {

/// Takes mass, momenta and inertia of every fragment that is stepped from its elements; fragments that an
/// anchor holds do not move. Call once a tick, and when fragments broke or woke.
template <class Real>
void beginMotions(Body<Real>& body);

/// Moves the fragments of a body on by a substep.
template <class Real>
void moveMotions(Body<Real>& body, double kick, double step, const Eigen::Vector3d& gravity);

/// Adds what a contact at the world point `at` does to a fragment [N], [N m].
void pushMotion(FragmentMotion& motion, const Eigen::Vector3d& at, const Eigen::Vector3d& force,
                const Eigen::Vector3d& torque);

/// Share of the normal force that a contact withholds while its two bodies separate (Poisson's hypothesis: a
/// blow gives back e^2 of the energy that it took), but not of the share `resting`
/// (resting_loads.h), unless they separate so fast that nothing rests.
/// `parting` is the speed at which they do [m/s], `jolt` the change of it that the contacts of both make in a
/// substep: below a quarter of that nobody can tell parting from trembling.
double withheld(double inelastic, double parting, double jolt, double resting);

}  // namespace rubble::edem
