// Brings the sums of the dust back from the GPU without waiting for it: a copy and a fence a step, looked at
// in later steps.
#pragma once

#include <array>
#include <vector>

#include "dust/gl/gl_kernel.h"
#include "gl/buffer.h"
#include "rubble/dust.h"

namespace rubble::dust {

class GlTotals {
 public:
  /// `volume` of a cell [m^3].
  GlTotals(const GlKernelSource& source, double volume);
  ~GlTotals();
  GlTotals(const GlTotals&) = delete;
  GlTotals& operator=(const GlTotals&) = delete;

  /// Takes what has arrived, then sends for the sums of now. `outflow`: DUST_BIND_OUTFLOW. `emitted` and
  /// `outside` [kg] are those of now; they are reported with the sums.
  void update(const gl::Buffer& density, const gl::Buffer& outflow, double emitted, double outside);
  const DustTotals& arrived() const { return m_arrived; }

 private:
  struct Flight {
    gl::Buffer copy;
    GLsync fence = nullptr;
    double emitted = 0, outside = 0;
  };
  // Steps whose sums may be under way; drivers queue two or three frames.
  static constexpr std::size_t kFlights = 4;

  void receive();
  DustTotals read(const Flight& flight);

  double m_volume;
  int m_chunks;  // of cells, in front of the six sides
  GlKernel m_sum;
  gl::Buffer m_sums;  // vec2 (value, remainder) of every chunk and side
  std::array<Flight, kFlights> m_flights;
  std::size_t m_oldest = 0;
  std::vector<float> m_values;
  DustTotals m_arrived;
};

}  // namespace rubble::dust
