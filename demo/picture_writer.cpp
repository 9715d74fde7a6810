#include "demo/picture_writer.h"

#include <utility>

#include "demo/window/png.h"

namespace rubble::demo {
namespace {

constexpr std::size_t kLongestQueue = 8;  // 1280 x 720 pictures: 30 MB

}  // namespace

PictureWriter::PictureWriter(std::filesystem::path folder, PictureList* list)
    : m_folder(std::move(folder)), m_list(list), m_thread([this] { work(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(m_mutex);
    m_stop = true;
  }
  m_changed.notify_all();
  m_thread.join();
}

void PictureWriter::save(int frame, Image image) {
  std::unique_lock lock(m_mutex);
  m_changed.wait(lock, [this] { return m_jobs.size() < kLongestQueue; });
  throwFailure();
  m_jobs.push_back({frame, std::move(image)});
  m_changed.notify_all();
}

void PictureWriter::finish() {
  std::unique_lock lock(m_mutex);
  m_changed.wait(lock, [this] { return m_jobs.empty(); });
  throwFailure();
}

void PictureWriter::throwFailure() {
  if (m_failure) std::rethrow_exception(std::exchange(m_failure, nullptr));
}

void PictureWriter::work() {
  std::unique_lock lock(m_mutex);
  while (true) {
    m_changed.wait(lock, [this] { return m_stop || !m_jobs.empty(); });
    if (m_jobs.empty()) return;
    const Job& job = m_jobs.front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (m_list) m_list->add(pictureName(job.frame));
      writePng(m_folder / pictureName(job.frame), job.image);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (!m_failure) m_failure = failure;
    m_jobs.pop_front();
    m_changed.notify_all();
  }
}

}  // namespace rubble::demo
