// Concrete, debris and props.
#include "shared/draw.h"
#include "draw/lighting.glsl"

layout(location = 0) in vec3 vPosition;
layout(location = 1) in vec3 vNormal;
layout(location = 2) in vec4 vRest;
layout(location = RUBBLE_OUTER_UNIFORM) uniform vec4 uOuter;  // colour, gloss
layout(location = RUBBLE_INNER_UNIFORM) uniform vec4 uInner;  // colour of fracture faces
layout(location = 0) out vec4 oColour;

// Periods of the grain [1/m] where its scale is 1: stains of a hand's width, sand of a millimetre.
const float kStains = 1.3;
const float kSand = 7.0;

void main() {
  float inner = vRest.w;
  vec3 rest = vRest.xyz / uFrame.tone.z;
  vec4 stains = texture(uNoise, rest * kStains);
  vec4 sand = texture(uNoise, rest * kSand);
  float chalk = 1.0 - uOuter.w;
  vec3 normal = normalize(normalize(vNormal) + (sand.rgb - 0.5) * chalk * mix(0.16, 0.8, inner));
  vec3 albedo = mix(uOuter.rgb, uInner.rgb, inner);
  albedo *= 1.0 + chalk * ((stains.a - 0.5) * 0.45 + (sand.a - 0.5) * mix(0.3, 0.6, inner));

  vec3 toSun = uFrame.sunDirection.xyz;
  float facing = max(dot(normal, toSun), 0.0);
  float sun = sunThroughSolids(vPosition, normalize(vNormal)) * sunThroughDust(vPosition);
  vec3 light = ambient(normal) + uFrame.sunColour.rgb * (facing * sun);
  vec3 colour = albedo * light;

  vec3 toEye = normalize(uFrame.eye.xyz - vPosition);
  vec3 halfway = normalize(toEye + toSun);
  float rim = pow(1.0 - max(dot(normal, toEye), 0.0), 5.0);
  float highlight = pow(max(dot(normal, halfway), 0.0), 60.0) * step(1e-4, facing) * sun;
  colour += uOuter.w * (highlight * 0.9 * uFrame.sunColour.rgb + (0.03 + 0.4 * rim) * uFrame.skyHorizon.rgb);
  oColour = vec4(colour, 1);
}
