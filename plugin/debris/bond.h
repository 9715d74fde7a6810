// Bond's law of comminution: which energy crushes an element, and how fine its largest grain is then (eq. 4).
#pragma once

namespace rubble::debris {

/// C_B of eq. (4) [J m^0.5] for one element.
///
/// Bond's work index Wi [kWh/t] gives the specific work w = 36 Wi / sqrt(d80) [J/kg] to mill a material from
/// infinite size until 80 % of it passes a sieve of opening d80 [m]. Under a Gaudin-Schuhmann distribution of
/// modulus m the sieve that passes 80 % has d80 = 2 x 0.8^(1/m) R_max, so W = w M = C_B / sqrt(R_max).
///
/// DEVIATION from the paper, which leaves C_B to the user: it follows from a tabulated constant of the
/// material, its share `crushEfficiency` (a mill wastes almost all of its energy; dimensionless, about 1e-3
/// to 1e-2) and the mass. Throws rubble::Error unless workIndex, crushEfficiency and elementMass [kg] are > 0
/// and 0 < sizeModulus <= 1.
double bondConstant(double workIndex, double crushEfficiency, double sizeModulus, double elementMass);

/// R_max of eq. (4) [m]: radius of the largest grain that fracture energy W [J] leaves. Infinite unless W >
/// 0.
double maxRadius(double bondConstant, double fractureEnergy);

/// True when the largest grain is smaller than the element of radius r [m]: the element falls to debris
/// (section 3.2).
bool isCrushed(double maxRadius, double elementRadius);

/// The fracture energy [J] above which an element of radius r [m] is crushed: eq. (4) solved for W at R_max =
/// r.
double crushingEnergy(double bondConstant, double elementRadius);

}  // namespace rubble::debris
