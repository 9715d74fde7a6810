// The floor: fine grain, and joints every metre (times the scale of the grain) so that motion and size can be read.
#include "shared/draw.h"
#include "draw/lighting.glsl"
#include "draw/sky.glsl"

layout(location = 0) in vec3 vPosition;
layout(location = RUBBLE_GROUND_UNIFORM) uniform vec4 uGround;
layout(location = 0) out vec4 oColour;

const float kJointWidth = 0.006;  // half width, of the distance of joints
const float kClear = 0.3;         // optical depth before the haze begins

// Share of a pixel that joints at whole metres cover, filtered over the pixel's footprint.
float joints(vec2 p) {
  vec2 footprint = max(fwidth(p), vec2(1e-5));
  vec2 away = abs(fract(p - 0.5) - 0.5);
  vec2 width = vec2(kJointWidth);
  vec2 cover = clamp((width - away) / footprint + 0.5, 0.0, 1.0) * min(width * 2.0 / footprint, vec2(1));
  return max(cover.x, cover.y);
}

void main() {
  vec3 normal = vec3(0, 1, 0);
  vec2 p = vPosition.xz / uFrame.tone.z;
  float stains = texture(uNoise, vec3(p * 0.23, 0.3)).a - 0.5;
  float sand = texture(uNoise, vec3(p * 3.1, 0.7)).a - 0.5;
  vec3 albedo = uGround.rgb * (1.0 + 0.3 * stains + 0.3 * sand) * (1.0 - 0.4 * joints(p));
  float sun = sunThroughSolids(vPosition, normal) * sunThroughDust(vPosition);
  vec3 light = ambient(normal) + uFrame.sunColour.rgb * (max(uFrame.sunDirection.y, 0.0) * sun);
  vec3 fromEye = vPosition - uFrame.eye.xyz;
  float haze = 1.0 - exp(-max(length(fromEye) * uFrame.tone.w - kClear, 0.0));
  vec3 horizon = skyColour(normalize(vec3(fromEye.x, 0, fromEye.z)));
  oColour = vec4(mix(albedo * light, horizon, haze * uFrame.tone.y), 1);
}
