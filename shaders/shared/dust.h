// What the dust kernels and both back ends must agree on: limits, binding numbers, struct layouts. Read by
// C++ and GLSL.
#ifndef RUBBLE_SHARED_DUST_H
#define RUBBLE_SHARED_DUST_H

// Storage buffers. Numbers stay below 8, the least GL 4.3 promises, so kernels of different jobs share them.
#define DUST_BIND_VELOCITY 0      // vec4[n^3]: air velocity [m/s], w unused
#define DUST_BIND_VELOCITY_2 1    // vec4[n^3]: curl, or the advected velocity
#define DUST_BIND_VELOCITY_OUT 2  // vec4[n^3]: result of the correction
#define DUST_BIND_DENSITY 3       // float[n^3] [kg/m^3]
#define DUST_BIND_AIR 5           // float[n^3]: 1 air, 0 solid
#define DUST_BIND_FACES \
  6                       // float[3 n^2 (n+1)]: normal velocity [m/s], later Courant number, of x, y, z faces
#define DUST_BIND_LIST 7  // sources, obstacles, indirect arguments or sums

// Storage buffers of the pressure kernels.
#define DUST_BIND_PRESSURE 0  // float[m^3] of this level [m^2/s]
#define DUST_BIND_RHS 1       // float[m^3] of this level [1/s]
#define DUST_BIND_INVERSE 2   // float[m^3]: 1 / diagonal [m^2], 0 in a solid
#define DUST_BIND_WEIGHTS 3   // float[6 m^3]: coefficient of each neighbour [1/m^2]; coarse levels only
#define DUST_BIND_COARSE_PRESSURE 4
#define DUST_BIND_COARSE_RHS 7
#define DUST_BIND_COARSE_INVERSE 6
#define DUST_BIND_COARSE_WEIGHTS 4  // where the coarse weights are made; the coarse pressure is not in use

#define DUST_BIND_OUTFLOW 5  // vec2[6 n^2]: (sum, Kahan compensation) of dust through the sides [kg/m^3]
#define DUST_BIND_PARAMS 0   // uniform buffer DustParams

// Plain uniforms, by location; each kernel uses what it needs.
#define DUST_UNIFORM_A 0
#define DUST_UNIFORM_B 1

#ifdef __cplusplus
#include <cstdint>
namespace rubble::shared {
struct alignas(16) vec4 {
  float x, y, z, w;
};
using uint = std::uint32_t;
#endif

// Incompressible flow holds well below the speed of sound; faster input is cut to it [m/s].
const float kDustMaxSpeed = 343.0f;
// Longest step [s]: a longer one is cut to it (the application paused; a leap would only smear the plume).
const float kDustMaxStep = 0.1f;
// Most mass of one source [kg]; a heavier one is not an element and is skipped.
const float kDustMaxSourceMass = 1.0e6f;
// Dust is carried at most one cell per substep, and there are at most this many of them.
const int kDustMaxSubsteps = 16;
// Weight of dust over the weight of air is cut at this: laden air falls no faster than freely.
const float kDustMaxLoad = 1.0f;
// Confinement turns the air of a cell by at most this angle a step [rad].
const float kDustMaxTurn = 0.5f;
// Keeps the normal of confinement finite where |curl| is level: a gradient of the curl far below any eddy
// [1/(m s)].
const float kDustLevelCurl = 1.0e-3f;
// Sponge at the five open sides: width [cells] and greatest rate of decay of the velocity [1/s].
const int kDustSpongeCells = 4;
const float kDustSpongeRate = 8.0f;
// Dust caught in a solid leaves through its faces at this Courant number per step, or faster if the body
// does.
const float kDustEviction = 0.1f;
// The coarsest level of the multigrid, and the sweeps made there.
const int kDustCoarsest = 4;
const int kDustCoarsestSweeps = 10;
// Cells summed by one work group of the reduction, and its threads.
const int kDustSumChunk = 4096;
const int kDustSumThreads = 64;

// One step's constants (std140).
struct DustParams {
  vec4 cell;     // size of a cell [m]; w: its smallest side
  vec4 origin;   // of the grid [m]; w: dt [s]
  vec4 inverse;  // 1 / size [1/m]; w: drag factor exp(-drag dt)
  vec4 forces;   // x: g / airDensity [m^4/(kg s^2)]; y: greatest sink g [m/s^2]; z: vorticity; w: settling
                 // [m/s]
};

// All dust raised in one cell this frame.
struct DustSourceCell {
  vec4 velocity;  // mass-weighted mean [m/s]; w: density to add [kg/m^3]
  uint cell;
  uint pad0, pad1, pad2;
};

// A solid, in grid coordinates.
struct DustSolid {
  vec4 position;  // of the centre [m], world; w: 0 sphere, 1 box
  vec4 axisX;     // rows of the inverse rotation; w: half extents [m] (a sphere's radius in axisX.w)
  vec4 axisY;
  vec4 axisZ;
  vec4 velocity;  // [m/s]
  vec4 spin;      // [rad/s]
};

// Arguments of glDispatchComputeIndirect for each substep, written by the GPU (the same number of substeps as
// on the CPU without a read-back), then what they follow from.
struct DustDispatch {
  uint x, y, z, pad;
};

#ifdef __cplusplus
}  // namespace rubble::shared
#endif

#endif
