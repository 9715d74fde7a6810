// Loaded before all else (LD_PRELOAD): a machine on which libEGL.so.1 is not installed.
#include <dlfcn.h>

#include <cstring>

extern "C" __attribute__((visibility("default"))) void* dlopen(const char* file, int mode) noexcept {
  if (file && std::strstr(file, "libEGL.so.1")) return nullptr;
  using Open = void* (*)(const char*, int);
  static const auto next = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  return next(file, mode);
}
