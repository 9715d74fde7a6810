// Compresses and writes pictures on a thread of its own, so that the next frame need not wait.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "demo/picture_list.h"
#include "rubble/render.h"

namespace rubble::demo {

class PictureWriter {
 public:
  /// Pictures go to `folder` as frame_0000.png and so on (pictureName), and into `list` if there is one. The
  /// list must outlive this object, and is used from its thread until finish() has returned.
  explicit PictureWriter(std::filesystem::path folder, PictureList* list = nullptr);
  /// Waits for what has been handed over.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Waits only when many pictures are queued. Throws what an earlier picture failed with.
  void save(int frame, Image image);
  /// Waits until every picture is on disk. Throws what one of them failed with.
  void finish();

 private:
  struct Job {
    int frame;
    Image image;
  };
  void work();
  void throwFailure();

  std::filesystem::path m_folder;
  PictureList* m_list;
  std::mutex m_mutex;
  std::condition_variable m_changed;
  std::deque<Job> m_jobs;  // the one at the front is being written
  bool m_stop = false;
  std::exception_ptr m_failure;
  std::thread m_thread;  // last: it uses all of the above
};

}  // namespace rubble::demo
