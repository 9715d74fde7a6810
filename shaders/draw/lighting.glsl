// Sun with shadow map and dust shadow, and a hemisphere of ambient light.
#include "draw/sun_in_dust.glsl"

layout(binding = RUBBLE_SHADOW_UNIT) uniform sampler2DShadow uShadow;
layout(binding = RUBBLE_NOISE_UNIT) uniform sampler3D uNoise;  // rgb gradient, a value; all about 0.5

// Share of the sun that solids let through: four bilinear taps on a tilted square, about three texels wide.
float sunThroughSolids(vec3 position, vec3 normal) {
  vec3 q = (uFrame.worldToShadow * vec4(position + normal * uFrame.sunDirection.w, 1)).xyz;
  q.z = clamp(q.z, 0.0, 1.0);
  vec2 texel = 1.0 / vec2(textureSize(uShadow, 0));
  float lit = 0.0;
  lit += texture(uShadow, q + vec3(vec2(-0.4, -1.1) * texel, 0));
  lit += texture(uShadow, q + vec3(vec2(1.1, -0.4) * texel, 0));
  lit += texture(uShadow, q + vec3(vec2(0.4, 1.1) * texel, 0));
  lit += texture(uShadow, q + vec3(vec2(-1.1, 0.4) * texel, 0));
  return 0.25 * lit;
}

float sunThroughDust(vec3 position) { return uFrame.dustMax.w == 0.0 ? 1.0 : sunInDust(position).x; }

vec3 ambient(vec3 normal) {
  return mix(uFrame.groundAmbient.rgb, uFrame.skyAmbient.rgb, 0.5 + 0.5 * normal.y);
}
