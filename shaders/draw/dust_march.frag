// Light through the dust along each ray, at half resolution: rgb scattered towards the eye, a what the scene
// behind keeps. A ray runs from the eye or the box of dusty cells to the solid it meets.
#include "shared/draw.h"
#include "draw/view_ray.glsl"
#include "draw/sun_in_dust.glsl"

layout(binding = RUBBLE_DEPTH_UNIT) uniform sampler2D uDepth;
layout(binding = RUBBLE_EXTINCTION_UNIT) uniform sampler3D uExtinction;
layout(std430, binding = RUBBLE_DUST_BOUNDS_BUFFER) readonly buffer Bounds { uint bLow[4], bHigh[4]; };
layout(location = RUBBLE_GRID_UNIFORM) uniform ivec4 uGrid;
layout(location = 0) in vec2 vUv;
layout(location = 0) out vec4 oDust;
layout(location = 1) out float oDistance;  // to the end of the ray [m]

const float kOpaque = 0.004;     // a ray ends when less than this is left: one step of an 8-bit picture
const float kForward = 0.45;     // asymmetry g of the forward lobe [Henyey and Greenstein 1941]
const float kLobe = 0.5;         // share of light in that lobe; the rest has lost its direction
const float kWhite = 0.55;       // a thick cloud of albedo 1 facing the sun, against a white surface
const float kSecond = 0.3;       // share of the sun that arrives after several scatterings ...
const float kSecondReach = 0.3;  // ... and is weakened by this share of the optical depth only
const float kDeepSky = 0.4;      // share of the sky's light that reaches places where the sun does not

// Interleaved gradient noise in [0, 1) [Jimenez 2014]: hides the steps, fixed to the pixel.
float jitter(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

float phase(float cosine) {
  float g = kForward;
  float lobe = (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
  return mix(1.0, lobe, kLobe);
}

// Where the ray enters and leaves the box of dusty cells [m].
vec2 dustyRange(vec3 origin, vec3 direction) {
  vec3 cell = (uFrame.dustMax.xyz - uFrame.dustMin.xyz) / float(uGrid.x);
  // Linear filtering carries dust half a cell past its cell's walls.
  vec3 low = max(uFrame.dustMin.xyz + cell * (vec3(bLow[0], bLow[1], bLow[2]) - 0.5), uFrame.dustMin.xyz);
  vec3 high = min(uFrame.dustMin.xyz + cell * (vec3(bHigh[0], bHigh[1], bHigh[2]) + 1.5), uFrame.dustMax.xyz);
  vec3 safe = mix(direction, vec3(1e-7), lessThan(abs(direction), vec3(1e-7)));
  vec3 a = (low - origin) / safe, b = (high - origin) / safe;
  vec3 nearest = min(a, b), farthest = max(a, b);
  return vec2(max(max(nearest.x, nearest.y), nearest.z), min(min(farthest.x, farthest.y), farthest.z));
}

void main() {
  // Of the four full pixels, the nearest and the farthest by turns, so that each side of an edge has a sample
  // to be upsampled from.
  vec4 depths = textureGather(uDepth, vUv);
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float nearest = min(min(depths.x, depths.y), min(depths.z, depths.w));
  float farthest = max(max(depths.x, depths.y), max(depths.z, depths.w));
  float depth = ((pixel.x + pixel.y) & 1) == 0 ? nearest : farthest;
  vec3 ray = worldAt(vUv, depth) - uFrame.eye.xyz;
  oDistance = length(ray);
  vec3 direction = ray / oDistance;

  vec2 range = dustyRange(uFrame.eye.xyz, direction);
  float from = max(range.x, 0.0), to = min(range.y, oDistance);
  bool dusty = bLow[0] <= bHigh[0] && to > from;
  int steps = dusty ? int(uFrame.dustMin.w) : 0;
  float stride = (to - from) / uFrame.dustMin.w;
  float sunlit = phase(dot(direction, uFrame.sunDirection.xyz));
  vec3 sky = 0.5 * (uFrame.skyAmbient.rgb + uFrame.groundAmbient.rgb);
  vec3 toGrid = 1.0 / (uFrame.dustMax.xyz - uFrame.dustMin.xyz);

  vec3 scattered = vec3(0);
  float kept = 1.0;
  float t = from + stride * jitter(gl_FragCoord.xy);
  for (int i = 0; i < steps && kept > kOpaque; ++i, t += stride) {
    vec3 p = uFrame.eye.xyz + direction * t;
    float extinction = textureLod(uExtinction, (p - uFrame.dustMin.xyz) * toGrid, 0.0).r;
    vec2 light = sunInDust(p);
    float solids = light.y / max(light.x, 1e-4);
    float second = kSecond * pow(max(light.x, 1e-4), kSecondReach) * solids;
    float sun = kWhite * (light.y * sunlit * (1.0 - kSecond) + second);
    vec3 source = uFrame.sunColour.rgb * sun + sky * mix(kDeepSky, 1.0, light.x);
    float through = exp(-extinction * stride);
    scattered += source * (kept * (1.0 - through));
    kept *= through;
  }
  oDust = vec4(scattered * uFrame.dustColour.rgb, kept);
}
