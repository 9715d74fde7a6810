// The number of substeps, and the arguments of their dispatches: no groups for those which are not needed.
#include "dust/grid.glsl"
#include "dust/schedule.glsl"
layout(local_size_x = 1) in;

void main() {
  float largest = uintBitsToFloat(bLargest);
  int substeps = int(ceil(clamp(largest, 1.0, float(kDustMaxSubsteps))));
  for (int s = 0; s < kDustMaxSubsteps; ++s) {
    bool needed = s < substeps;
    bDispatch[s] = DustDispatch(needed ? uint(n / DUST_GROUP_X) : 0u, uint(n), 1u, 0u);
  }
  bSubsteps = uint(substeps);
  bLargest = 0;  // for the next step
}
