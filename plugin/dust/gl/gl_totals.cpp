#include "dust/gl/gl_totals.h"

#include "shared/dust.h"

namespace rubble::dust {

namespace {

constexpr int kSides = 6;
constexpr int kFloor = 2;  // low x, high x, low y, ...

int chunksOf(int n) {
  return (n * n * n + shared::kDustSumChunk - 1) / shared::kDustSumChunk;
}

}  // namespace

GlTotals::GlTotals(const GlKernelSource& source, double volume)
    : m_volume(volume),
      m_chunks(chunksOf(source.n())),
      m_sum(source.build("sums.comp")),
      m_values(2 * std::size_t(m_chunks + kSides)) {
  m_sums = gl::bufferOf<float>(m_values.size());
  for (Flight& f : m_flights) f.copy = gl::Buffer(m_values.size() * sizeof(float), GL_STREAM_READ);
}

GlTotals::~GlTotals() {
  for (const Flight& f : m_flights) {
    if (f.fence != nullptr) glDeleteSync(f.fence);
  }
}

void GlTotals::update(const gl::Buffer& density, const gl::Buffer& outflow, double emitted, double outside) {
  receive();
  // All under way: these sums are left out. Nothing is lost, the next ones hold what went before.
  std::size_t free = 0;
  while (free < kFlights && m_flights[(m_oldest + free) % kFlights].fence != nullptr) ++free;
  if (free == kFlights) return;

  density.bindStorage(DUST_BIND_DENSITY);
  outflow.bindStorage(DUST_BIND_OUTFLOW);
  m_sums.bindStorage(DUST_BIND_LIST);
  m_sum.run(m_chunks + kSides);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);

  Flight& flight = m_flights[(m_oldest + free) % kFlights];
  glBindBuffer(GL_COPY_READ_BUFFER, m_sums.id());
  glBindBuffer(GL_COPY_WRITE_BUFFER, flight.copy.id());
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, GLsizeiptr(m_sums.bytes()));
  flight.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  flight.emitted = emitted;
  flight.outside = outside;
  glFlush();  // or the fence might stay in the driver's queue
}

void GlTotals::receive() {
  for (std::size_t i = 0; i < kFlights; ++i) {
    Flight& flight = m_flights[m_oldest];
    if (flight.fence == nullptr) return;
    const GLenum state = glClientWaitSync(flight.fence, 0, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return;
    glDeleteSync(flight.fence);
    flight.fence = nullptr;
    m_arrived = read(flight);
    m_oldest = (m_oldest + 1) % kFlights;
  }
}

DustTotals GlTotals::read(const Flight& flight) {
  flight.copy.read(std::as_writable_bytes(std::span(m_values)));
  const auto sum = [&](int i) {
    return double{m_values[2 * std::size_t(i)]} + double{m_values[2 * std::size_t(i) + 1]};
  };
  double air = 0, left = 0;
  for (int i = 0; i < m_chunks; ++i) air += sum(i);
  for (int side = 0; side < kSides; ++side) left += side == kFloor ? 0 : sum(m_chunks + side);
  return {flight.emitted, air * m_volume, sum(m_chunks + kFloor) * m_volume,
          left * m_volume + flight.outside};
}

}  // namespace rubble::dust
