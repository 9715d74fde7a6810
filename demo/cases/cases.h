// The cases of `rubble report`, one file each.
#pragma once

#include <Eigen/Core>

#include "demo/report_case.h"

namespace rubble::demo {

ReportCase cantileverCase();
ReportCase supportedBeamCase();
ReportCase bounceCase();
ReportCase freeSpinCase();
ReportCase slideCase();
ReportCase reposeCase();
ReportCase rollCase();
ReportCase hungCase();
ReportCase waveCase();
ReportCase strengthCase();
ReportCase springBreakCase();
ReportCase crushCase();
ReportCase debrisFallCase();
ReportCase sieveCase();
ReportCase dustRotationCase();
ReportCase dustTaylorGreenCase();
ReportCase dustDivergenceCase();
ReportCase dustPlumeCase();
ReportCase wallBlowCase();
ReportCase columnBlowCase();
ReportCase twoFragileBlowCase();

/// Sag of a cantilever of square section under its own weight at the distance x from its root [m], by
/// Timoshenko's theory of beams (Strength of Materials I), for a lattice of Poisson's ratio 0: shear modulus
/// E / 2, shear coefficient 5 / 6. Lengths in metres, density in kg/m^3, modulus in Pa, gravity in m/s^2.
double timoshenkoSag(double length, double height, double x, double density, double modulus, double gravity);

/// On two bars under its ends, of square section [m].
struct SupportedBeam {
  double length, height, span;
};

/// Its sag at the distance x from its middle below what lies over the bars [m], |x| <= span / 2, by the same
/// theory; what stands over beyond the bars bends it back. Units as of timoshenkoSag.
double supportedSag(const SupportedBeam& beam, double x, double density, double modulus, double gravity);

/// Longest period of such a cantilever [s], by the frequency equation of Timoshenko's beam: Huang, The effect
/// of rotatory inertia and of shear deformation on the frequency and normal mode equations of uniform beams
/// with simple end conditions, J. Appl. Mech. 28, 1961. Units as of timoshenkoSag.
double timoshenkoPeriod(double length, double height, double density, double modulus);

/// How long a mass on a spring that only pushes touches it [s]: half a period. [kg], [N/m].
double springContactSeconds(double mass, double stiffness);

/// Attitude of a free rigid body after that time [s], the identity at first, by Euler's equations: inertia
/// about the centre of mass [kg m^2] and spin [rad/s] at the start.
Eigen::Matrix3d tumbled(const Eigen::Matrix3d& inertia, const Eigen::Vector3d& spin, double seconds);

/// Of a plane that tilts at `rate` [rad/s] when what lies on it has slid by `way` [m]: it stands up to
/// atan(friction), and then goes by g (sin a - friction cos a) [rad].
double slidAngle(double way, double friction, double rate, double gravity);

/// Of what slides on level ground under Coulomb's friction [m]. [m/s], dimensionless, [m/s^2].
double stopDistance(double speed, double friction, double gravity);

/// How far a point of a bar hung by its top sinks under the bar's weight [m], small strains; `depth` is its
/// distance from the top at rest. Units as of timoshenkoSag.
double hungSink(double length, double depth, double density, double modulus, double gravity);

/// How long sound takes along a bar of Poisson's ratio 0 [s]. [m], [kg/m^3], [Pa].
double waveSeconds(double length, double density, double modulus);

/// Force at which a bar parts that is pulled along [N]. [Pa], [m^2].
double partingForce(double strength, double area);

/// Shear strength c without pressure of a material of Mohr and Coulomb's law that is as strong as asked in
/// tension and in compression: their circles touch it [Pa].
double cohesionOf(double tensileStrength, double compressiveStrength);

/// Moment at which a beam of square section of that edge [m] reaches a tensile strength at its side [N m].
double squareBendingMoment(double strength, double edge);

/// Torque at which a square bar reaches a shear strength in the middle of its sides [N m]: Timoshenko and
/// Goodier, Theory of Elasticity, 3rd ed., 1970, article 109.
double squareTwistingMoment(double strength, double edge);

/// What is left of the velocity of Taylor and Green's vortex in a plane. [m^2/s], [1/m], [s].
double taylorGreenDecay(double viscosity, double wave, double seconds);

/// Of a ball of air that carries `load` of its weight in dust, as it is let go in still air, under
/// Boussinesq's law: the dust weighs, and is not moved as mass [m/s^2].
double ladenBallAcceleration(double load, double gravity);

/// Of a full sphere that rolls down a slope [rad] without slipping [m/s^2].
double rollingAcceleration(double gravity, double slope);

/// Terminal speed of a fine grain by Stokes' law, buoyancy left out [m/s]. [m], [kg/m^3], [m/s^2], [Pa s].
double stokesSpeed(double radius, double density, double gravity, double viscosity);

/// How far a thing has fallen from rest under a drag that goes with the square of its speed [m].
double fallenWay(double terminalSpeed, double gravity, double seconds);

/// Share of the mass in grains up to `radius` by Gaudin and Schuhmann's law. [m], dimensionless, [m].
double sievedShare(double maxRadius, double modulus, double radius);

}  // namespace rubble::demo
