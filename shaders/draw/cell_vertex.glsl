// Eq. (8): a copy of a cell vertex follows the mean of the elements its mask names. Copies with the same mask
// add the same terms in the same order, so that they meet to the last bit and no crack shows between joined
// cells.
struct ElementPose {
  vec4 place;     // xyz position [m], w alive
  vec4 rotation;  // unit quaternion
};
layout(std430, binding = RUBBLE_POSES_BUFFER) readonly buffer Poses { ElementPose bPoses[]; };
layout(std430, binding = RUBBLE_MASKS_BUFFER) readonly buffer Masks { uint bMasks[]; };

uint maskOf(uint vertex, uint owner) {
  return bMasks[vertex >> 1] >> ((vertex & 1u) * 16u + owner * 4u) & 15u;
}

// Place and normal of a copy; the normals turn with the elements that the copy follows, so that the sides of a
// border between joined cells are lit alike. It is a little
// shorter than 1 where these turn apart.
void cellCopy(uint vertex, uint owner, vec3 restNormal, out vec3 place, out vec3 normal) {
  CellVertex cell = bCellVertices[vertex];
  uint mask = maskOf(vertex, owner);
  vec3 sum = vec3(0);
  normal = vec3(0);
  float weights = 0;
  for (uint j = 0u; j < 4u; ++j) {
    if ((mask >> j & 1u) == 0u) continue;
    uint element = cell.elements[j];
    ElementPose pose = bPoses[element];
    sum += pose.place.xyz + rotate(pose.rotation, cell.position.xyz - bRestCentres[element].xyz);
    normal += rotate(pose.rotation, restNormal);
    weights += 1;
  }
  place = sum / weights;
  normal /= weights;
}
