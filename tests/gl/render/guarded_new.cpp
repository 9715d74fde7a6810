#include "gl/render/guarded_new.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

[[maybe_unused]] constexpr std::size_t kHeader = 16;  // keeps the alignment of malloc
[[maybe_unused]] constexpr std::size_t kGuard = 512;
[[maybe_unused]] constexpr unsigned char kPattern = 0xc5;

std::atomic<std::size_t> overruns{0};

}  // namespace

// The address sanitizer has its own, and stops at the write itself.
#ifndef __SANITIZE_ADDRESS__

void* operator new(std::size_t size) {
  auto* block = static_cast<unsigned char*>(std::malloc(kHeader + size + kGuard));
  if (block == nullptr) throw std::bad_alloc();
  new (block) std::size_t(size);
  std::fill_n(block + kHeader + size, kGuard, kPattern);
  return block + kHeader;
}

void operator delete(void* pointer) noexcept {
  if (pointer == nullptr) return;
  unsigned char* block = static_cast<unsigned char*>(pointer) - kHeader;
  const std::size_t size = *std::launder(static_cast<std::size_t*>(static_cast<void*>(block)));
  const unsigned char* guard = block + kHeader + size;
  if (!std::all_of(guard, guard + kGuard, [](unsigned char byte) { return byte == kPattern; })) ++overruns;
  std::free(block);
}

void operator delete(void* pointer, std::size_t) noexcept {
  operator delete(pointer);
}

#endif

namespace rubble::test {

std::size_t overrunBlocks() {
  return overruns;
}

}  // namespace rubble::test
