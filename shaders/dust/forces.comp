// Confinement of eddies, weight of the dust, drag and the sponge at the open sides.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_VELOCITY) buffer Velocity { vec4 bVelocity[]; };
layout(std430, binding = DUST_BIND_VELOCITY_2) readonly buffer Curl { vec4 bCurl[]; };
layout(std430, binding = DUST_BIND_DENSITY) readonly buffer Density { float bDensity[]; };

float slope(ivec3 c, int axis) {
  return bCurl[index(min(c + along(axis), n - 1))].w - bCurl[index(max(c - along(axis), 0))].w;
}

// Change of velocity by confinement: eps h |w| (N x w) dt with N the direction in which |w| grows; the angle
// |w| dt is cut. Fedkiw's eps h (N x w) carries a hidden 1/s.
vec3 confinement(ivec3 c, float dt) {
  vec4 w = bCurl[index(c)];
  vec3 rise = vec3(slope(c, 0), slope(c, 1), slope(c, 2)) * (0.5 * params.inverse.xyz);
  float strength = params.forces.z * params.cell.w;
  return cross(rise, w.xyz) * (strength * min(w.w * dt, kDustMaxTurn) / (length(rise) + kDustLevelCurl));
}

// Decay rate of the sponge [1/s] at `distance` cells from an open side.
float spongeRate(int distance) {
  float d = 1 - float(distance) / float(kDustSpongeCells);
  return d > 0 ? kDustSpongeRate * d * d : 0;
}

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  int i = index(c);
  float dt = params.origin.w;
  vec3 u = bVelocity[i].xyz;
  if (params.forces.z > 0) u += confinement(c, dt);
  u.y -= min(params.forces.x * bDensity[i], params.forces.y) * dt;
  ivec3 high = n - 1 - c;
  int distance = min(min(min(c.x, high.x), high.y), min(c.z, high.z));  // the floor is not open
  u *= params.inverse.w / (1 + spongeRate(distance) * dt);
  bVelocity[i] = bounded(vec4(u, 0), vec4(-kDustMaxSpeed), vec4(kDustMaxSpeed));
}
