// Adds half of what a step back fails to restore, kept within the eight cells of the departure point of the
// old field.
#include "dust/grid.glsl"
#include "dust/trace.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_VELOCITY_2) readonly buffer Forward { vec4 bForward[]; };
layout(std430, binding = DUST_BIND_VELOCITY_OUT) writeonly buffer Corrected { vec4 bCorrected[]; };

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  int i = index(c);
  vec3 way = bVelocity[i].xyz * (params.origin.w * params.inverse.xyz);
  Corner to = locate(vec3(c) + way);
  vec4 v[8];
  for (int k = 0; k < 8; ++k) v[k] = bForward[to.base + offsetOf(k)];
  vec4 value = bForward[i] + (bVelocity[i] - blend(v, to.f)) * 0.5;
  Corner from = locate(vec3(c) - way);
  vec4 low = bVelocity[from.base], high = low;
  for (int k = 1; k < 8; ++k) {
    vec4 corner = bVelocity[from.base + offsetOf(k)];
    low = min(low, corner);
    high = max(high, corner);
  }
  bCorrected[i] = bounded(value, low, high);
}
