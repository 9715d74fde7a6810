// Bindings and block layouts of the drawing shaders. Included by C++ (plugin/render) and by GLSL
// (shaders/draw).
#ifndef RUBBLE_SHARED_DRAW_H
#define RUBBLE_SHARED_DRAW_H

// Uniform blocks
#define RUBBLE_FRAME_BLOCK 0

// Storage buffers
#define RUBBLE_POSES_BUFFER 0          // ElementPose of one body
#define RUBBLE_REST_CENTRES_BUFFER 1   // vec4 centre of every element at rest
#define RUBBLE_CELL_VERTICES_BUFFER 2  // vec4 position at rest, uvec4 elements
#define RUBBLE_MASKS_BUFFER 3          // 16 bits a cell vertex, two in a word
#define RUBBLE_DENSITY_BUFFER 4        // float dust density of every grid cell [kg/m^3]
#define RUBBLE_DUST_BOUNDS_BUFFER 5    // uvec4 lowest and highest grid cell that holds dust

// Texture units
#define RUBBLE_SHADOW_UNIT 0
#define RUBBLE_NOISE_UNIT 1
#define RUBBLE_DUST_LIGHT_UNIT 2
#define RUBBLE_EXTINCTION_UNIT 3
#define RUBBLE_COLOUR_UNIT 4
#define RUBBLE_DEPTH_UNIT 5
#define RUBBLE_DUST_UNIT 6
#define RUBBLE_DUST_DEPTH_UNIT 7

// Image units
#define RUBBLE_EXTINCTION_IMAGE 0
#define RUBBLE_DUST_LIGHT_IMAGE 1

// Vertex attributes
#define RUBBLE_CORNER_ATTRIBUTE 0    // uint: cell vertex * 4 + place of the owner among its elements
#define RUBBLE_NORMAL_ATTRIBUTE 1    // vec4: normal at rest; w is 1 on fracture faces
#define RUBBLE_PLACE_ATTRIBUTE 2     // vec4: debris position, scale
#define RUBBLE_ROTATION_ATTRIBUTE 3  // vec4: debris orientation
#define RUBBLE_ELEMENT_ATTRIBUTE 4   // uint: debris element
#define RUBBLE_POSITION_ATTRIBUTE 5  // vec3: vertex of a prop

// Uniforms with a place of their own
#define RUBBLE_OUTER_UNIFORM 0       // vec4: colour of the surface, gloss
#define RUBBLE_INNER_UNIFORM 1       // vec4: colour of fracture faces, unused
#define RUBBLE_MODEL_UNIFORM 2       // mat4 (takes one location)
#define RUBBLE_GROUND_UNIFORM 3      // vec4: colour, height
#define RUBBLE_GRID_UNIFORM 4        // ivec4: cells along an axis of the dust grid (x)
#define RUBBLE_EXTINCTION_UNIFORM 5  // float: mass extinction times opacity [m^2/kg]

// Work-group of the volume kernels; 64 x 4 x 1 was the fastest shape measured in software.
#define RUBBLE_COPY_GROUP_X 64
#define RUBBLE_COPY_GROUP_Y 4
#define RUBBLE_LIGHT_GROUP 8

#ifdef __cplusplus
#include <Eigen/Core>
namespace rubble::shared {
using mat4 = Eigen::Matrix4f;
using vec4 = Eigen::Vector4f;
#endif

// Constant during a frame (std140).
struct Frame {
  mat4 viewProjection;
  mat4 inverseViewProjection;
  mat4 worldToShadow;     // to [0, 1]^3 of the shadow map
  mat4 worldToDustLight;  // to [0, 1]^3 of the light volume
  mat4 dustLightToWorld;
  vec4 eye;           // xyz [m]
  vec4 sunDirection;  // xyz unit, towards the sun; w: offset along the normal against shadow acne [m]
  vec4 sunColour;
  vec4 skyAmbient;
  vec4 groundAmbient;
  vec4 skyZenith;
  vec4 skyHorizon;
  vec4 viewport;    // width, height, 1 / width, 1 / height of the full picture
  vec4 tone;        // x exposure, y 1 with the tone curve, z size of the grain, w haze [1/m]
  vec4 dustMin;     // xyz corner of the dust grid [m]; w steps of a ray
  vec4 dustMax;     // xyz the other corner; w 1 when there is a grid
  vec4 dustColour;  // rgb albedo; w step of the light volume along the sunlight [m]
};

#ifdef __cplusplus
}  // namespace rubble::shared
#else
layout(std140, binding = RUBBLE_FRAME_BLOCK) uniform FrameBlock {
  Frame uFrame;
};
#endif

#endif
