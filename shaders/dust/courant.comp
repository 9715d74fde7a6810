// Face velocities -> Courant numbers of the dust for the whole step: air velocity, less the settling speed on
// y faces; out of a solid at least the eviction; nothing into a solid nor inside one.
#include "dust/grid.glsl"
#include "dust/schedule.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_AIR) readonly buffer Air { float bAir[]; };
layout(std430, binding = DUST_BIND_FACES) buffer Faces { float bFaces[]; };

shared uint sLargest;

float courant(float value, float airLow, float airHigh) {
  if (airLow == airHigh) return value * airLow;
  return airLow < airHigh ? max(value, kDustEviction) : min(value, -kDustEviction);
}

float convert(int axis, ivec3 face, float airLow, float airHigh) {
  int i = faceOf(axis, face);
  float settling = axis == 1 ? params.forces.w : 0;
  float value = courant((bFaces[i] - settling) * (params.origin.w * params.inverse[axis]), airLow, airHigh);
  bFaces[i] = value;
  return abs(value);
}

void main() {
  if (gl_LocalInvocationIndex == 0) sLargest = 0;
  barrier();
  ivec3 c = ivec3(gl_GlobalInvocationID);
  float air = bAir[index(c)], most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    most = max(most, convert(axis, c, bAir[index(max(c - along(axis), 0))], air));
    if (c[axis] == n - 1) most = max(most, convert(axis, c + along(axis), air, air));
  }
  atomicMax(sLargest, floatBitsToUint(most));
  barrier();
  if (gl_LocalInvocationIndex == 0) atomicMax(bLargest, sLargest);
}
