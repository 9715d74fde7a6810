// Written by the GPU, so that it makes as many substeps as the CPU would without a read-back.
layout(std430, binding = DUST_BIND_LIST) buffer Schedule {
  DustDispatch bDispatch[kDustMaxSubsteps];
  uint bLargest;  // bits of the largest |Courant number|: floats from 0 up are in the order of their bits
  uint bSubsteps;
};
