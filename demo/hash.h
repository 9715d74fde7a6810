// FNV-1a, 64 bits, over the bytes of plain values.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace rubble::demo {

class Fnv1a {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) {
    for (const unsigned char byte : std::bit_cast<std::array<unsigned char, sizeof(T)>>(value)) {
      m_value = (m_value ^ byte) * 0x100000001b3u;  // the FNV prime of 64 bits
    }
  }
  std::uint64_t value() const { return m_value; }

 private:
  std::uint64_t m_value = 0xcbf29ce484222325u;  // the FNV offset basis of 64 bits
};

}  // namespace rubble::demo
