// The cases of `rubble report`, one file each.
#pragma once

#include "demo/report_case.h"

namespace rubble::demo {

ReportCase cantileverCase();

/// Sag of a cantilever of square section under its own weight at the distance x from its root [m], by
/// Timoshenko's theory of beams (Strength of Materials I), for a lattice of Poisson's ratio 0: shear modulus
/// E / 2, shear coefficient 5 / 6. Lengths in metres, density in kg/m^3, modulus in Pa, gravity in m/s^2.
double timoshenkoSag(double length, double height, double x, double density, double modulus, double gravity);

}  // namespace rubble::demo
