// Threads of the CPU back end. A range is cut into one contiguous part a thread; bodies write only what
// belongs to their part, so the bits do not depend on the number of threads.
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>
#include <thread>
#include <type_traits>
#include <vector>

namespace rubble::base {

class ThreadPool {
 public:
  /// `threads` counts the caller; with 1 no thread is made.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls body(begin, end) for parts of [0, count) and returns when all are done. `cost` is the work of one
  /// item in cells: a small range runs on the caller, waking threads would take longer. `body` must not
  /// throw. Not reentrant.
  template <class Body>
  void run(int count, int cost, Body&& body) {
    assert(count >= 0 && cost >= 0);
    if (m_threads.empty() || std::int64_t(count) * cost < kLeastWork) {
      body(0, count);
      return;
    }
    using Plain = std::remove_reference_t<Body>;
    dispatch(
        count, [](void* context, int begin, int end) { (*static_cast<Plain*>(context))(begin, end); }, &body);
  }

 private:
  using Call = void (*)(void*, int, int);
  // Waking a thread takes some 10 microseconds, as long as a few thousand cells of the cheapest pass.
  static constexpr std::int64_t kLeastWork = 8192;

  void dispatch(int count, Call call, void* context);
  void work(int part);
  void runPart(int part) const;

  Call m_call = nullptr;
  void* m_context = nullptr;
  int m_count = 0;
  std::atomic<std::uint32_t> m_round{0};
  std::atomic<int> m_pending{0};
  std::atomic<bool> m_stop{false};
  std::vector<std::thread> m_threads;
};

}  // namespace rubble::base
