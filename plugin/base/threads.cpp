#include "base/threads.h"

namespace rubble::base {

ThreadPool::ThreadPool(int threads) {
  for (int part = 1; part < threads; ++part) m_threads.emplace_back([this, part] { work(part); });
}

ThreadPool::~ThreadPool() {
  m_stop.store(true, std::memory_order_relaxed);
  m_round.fetch_add(1, std::memory_order_release);
  m_round.notify_all();
  for (std::thread& t : m_threads) t.join();
}

void ThreadPool::runPart(int part) const {
  const std::int64_t parts = std::int64_t(m_threads.size()) + 1;
  const auto begin = int(part * std::int64_t{m_count} / parts);
  const auto end = int((part + 1) * std::int64_t{m_count} / parts);
  if (begin < end) m_call(m_context, begin, end);
}

void ThreadPool::dispatch(int count, Call call, void* context) {
  m_call = call;
  m_context = context;
  m_count = count;
  m_pending.store(int(m_threads.size()), std::memory_order_relaxed);
  m_round.fetch_add(1, std::memory_order_release);
  m_round.notify_all();
  runPart(0);
  for (int left = m_pending.load(std::memory_order_acquire); left != 0;
       left = m_pending.load(std::memory_order_acquire)) {
    m_pending.wait(left, std::memory_order_acquire);
  }
}

void ThreadPool::work(int part) {
  for (std::uint32_t seen = 0;; ++seen) {
    m_round.wait(seen, std::memory_order_acquire);
    if (m_stop.load(std::memory_order_relaxed)) return;
    runPart(part);
    if (m_pending.fetch_sub(1, std::memory_order_acq_rel) == 1) m_pending.notify_one();
  }
}

}  // namespace rubble::base
