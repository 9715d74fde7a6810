// Scene and dust together, tone curve, gamma. RUBBLE_DUST is defined when there is dust: a software
// rasteriser executes both sides of a branch, and the dust's is three quarters of this pass.
#include "shared/draw.h"
#include "draw/view_ray.glsl"

layout(binding = RUBBLE_COLOUR_UNIT) uniform sampler2D uColour;
layout(binding = RUBBLE_DEPTH_UNIT) uniform sampler2D uDepth;
layout(binding = RUBBLE_DUST_UNIT) uniform sampler2D uDust;
layout(binding = RUBBLE_DUST_DEPTH_UNIT) uniform sampler2D uDustDistance;
layout(location = 0) in vec2 vUv;
layout(location = 0) out vec4 oColour;

// Relative difference of distances within which two pixels see the same surface.
const float kSameSurface = 0.01;

// Half resolution -> full: bilinear weights, times how alike the distances are.
vec4 dustAt(vec2 uv, float distance) {
  vec2 size = vec2(textureSize(uDust, 0));
  vec2 at = uv * size - 0.5;
  vec2 part = fract(at);
  ivec2 corner = ivec2(floor(at));
  vec4 sum = vec4(0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 side = ivec2(i & 1, i >> 1);
    ivec2 texel = clamp(corner + side, ivec2(0), ivec2(size) - 1);
    vec2 near = mix(1.0 - part, part, vec2(side));
    float apart = abs(texelFetch(uDustDistance, texel, 0).r - distance) / (distance * kSameSurface);
    float weight = (near.x * near.y + 1e-3) / (1.0 + apart * apart * apart * apart);
    sum += weight * texelFetch(uDust, texel, 0);
    weights += weight;
  }
  return sum / weights;
}

// Filmic curve [Narkowicz 2015, a fit to the ACES reference].
vec3 film(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }

// sRGB, IEC 61966-2-1; its power by a fit of square roots [Taylor 2010], within 0.001 of it and three times
// as fast in software.
vec3 encode(vec3 linear) {
  vec3 half_ = sqrt(linear), quarter = sqrt(half_), eighth = sqrt(quarter);
  vec3 curve = 0.662002687 * half_ + 0.684122060 * quarter - 0.323583601 * eighth - 0.0225411470 * linear;
  return mix(linear * 12.92, curve, greaterThan(linear, vec3(0.0031308)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 colour = texelFetch(uColour, pixel, 0).rgb;
#ifdef RUBBLE_DUST
  float distance = length(worldAt(vUv, texelFetch(uDepth, pixel, 0).r) - uFrame.eye.xyz);
  vec4 dust = dustAt(vUv, distance);
  colour = colour * dust.a + dust.rgb;
#endif
  colour *= uFrame.tone.x;
  colour = uFrame.tone.y != 0.0 ? film(colour) : clamp(colour, 0.0, 1.0);
  oColour = vec4(encode(colour), 1);
}
