// How far a body is from one that rests in its shape: what its host asks before it takes it as a whole.
#pragma once

#include "edem/body.h"

namespace rubble::edem {

struct Unrest {
  double speed = 0;        ///< of its fastest surface by its motion as a whole [m/s]
  double trembling = 0;    ///< largest speed of an element's surface beside that motion [m/s]
  double deformation = 0;  ///< furthest that an element is from where an unbroken body would be parked [m]
  /// Largest tension that the energy of a spring makes on its face, over the tensile strength; dimensionless.
  double stress = 0;
  double overlap = 0;  ///< furthest that its cells and a rigid body are in each other [m]
};

/// Of a body of one fragment, but for its overlap.
template <class Real>
Unrest unrestOf(const Body<Real>& body);

}  // namespace rubble::edem
