// Moves the dust along one axis [vanLeer77]: a thread takes a line of cells from its low end to its high end.
// A line in one thread needs no second buffer, and what leaves a cell is the same number that enters its
// neighbour.
#include "dust/grid.glsl"
#include "dust/schedule.glsl"
layout(local_size_x = DUST_GROUP_X) in;

layout(std430, binding = DUST_BIND_DENSITY) buffer Density { float bDensity[]; };
layout(std430, binding = DUST_BIND_FACES) readonly buffer Faces { float bFaces[]; };
layout(std430, binding = DUST_BIND_OUTFLOW) buffer Outflow { vec2 bOutflow[]; };
layout(location = DUST_UNIFORM_A) uniform int uAxis;

// Slope of the monotonised central limiter, from the differences behind and ahead.
float limitedSlope(float behind, float ahead) {
  float size = min(0.5 * abs(behind + ahead), 2 * min(abs(behind), abs(ahead)));
  return behind * ahead > 0 ? (ahead < 0 ? -size : size) : 0;
}

// Flux through the face between q[1] and q[2] [kg/m^3 of a cell]: the integral of the upwind cell's linear
// profile over the part that crosses. The profile is nowhere negative, and a cell that gives to both sides
// gives at most what it holds, so no density can fall below zero. c: Courant numbers of the face before, of
// this one and of the next.
float fluxOf(vec4 q, vec3 c) {
  bool up = c.y > 0;
  float gives = up ? c.y - min(c.x, 0) : max(c.z, 0) - c.y;
  float cut = c.y / max(gives, 1.0);
  float own = up ? q[1] : q[2];
  float ahead = up ? q[2] - q[1] : q[1] - q[2];
  float behind = up ? q[1] - q[0] : q[2] - q[3];
  return cut * (own + 0.5 * (1 - abs(cut)) * limitedSlope(behind, ahead));
}

// Kahan's sum: thousands of frames of thin flux are not lost in what has gone before.
void countOut(int slot, float amount) {
  precise vec2 sum = bOutflow[slot];
  precise float y = amount - sum.y;
  precise float t = sum.x + y;
  sum.y = (t - sum.x) - y;
  bOutflow[slot] = vec2(t, sum.y);
}

void main() {
  ivec2 id = ivec2(gl_GlobalInvocationID.xy);
  ivec3 start = uAxis == 0 ? ivec3(0, id) : uAxis == 1 ? ivec3(id.x, 0, id.y) : ivec3(id, 0);
  int cell = index(start), face = faceOf(uAxis, start);
  int cellStride = index(along(uAxis)), faceStride = uAxis == 2 ? n * n : uAxis == 1 ? n : 1;
  float share = 1 / float(bSubsteps);
  int slot = 2 * uAxis * n * n + id.y * n + id.x;

  // Beyond a side the last cell repeats: no slope there.
  vec4 q = vec4(vec3(bDensity[cell]), bDensity[cell + cellStride]);
  vec3 c = vec3(0, bFaces[face], bFaces[face + faceStride]);
  float last = 0;
  for (int k = 0; k <= n; ++k) {
    float flux = fluxOf(q, c * share);
    // Nothing flows in from outside: there is no dust.
    if (k == 0) flux = min(flux, 0);
    if (k == n) flux = max(flux, 0);
    if (k == 0) countOut(slot, -flux);
    if (k == n) countOut(slot + n * n, flux);
    if (k > 0) bDensity[cell + (k - 1) * cellStride] = max(q[1] + (last - flux), 0);
    last = flux;
    q = vec4(q.yzw, bDensity[cell + min(k + 2, n - 1) * cellStride]);
    c = vec3(c.yz, bFaces[face + min(k + 2, n) * faceStride]);
  }
}
