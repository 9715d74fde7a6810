// FNV-1a, 64 bits [Fowler, Noll, Vo]: the one hash of states, events, caches and files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

namespace rubble::base {

class Fnv1a {
 public:
  void add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) m_value = (m_value ^ std::uint64_t(byte)) * kPrime;
  }
  /// The bytes of a plain number.
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add(std::as_bytes(std::span(&value, 1))); }
  /// The bytes of all numbers of a vector or matrix, one after the other.
  template <class Vector>
  void addAll(const Vector& vector) {
    for (std::ptrdiff_t i = 0; i < vector.size(); ++i) add(vector(i));
  }
  std::uint64_t value() const { return m_value; }

  static constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325u;
  static constexpr std::uint64_t kPrime = 0x00000100000001b3u;

 private:
  std::uint64_t m_value = kOffsetBasis;
};

/// The checksum of files: FNV-1a over little-endian 64-bit words instead of bytes, in one or in eight lanes
/// that take turns, so that a core works on eight words at once. The sum of eight is that of the lanes as
/// words. Each step is a bijection of the state and of the word, so a change confined to one word is always
/// seen.
class FileChecksum {
 public:
  static constexpr int kLanes = 8;

  explicit FileChecksum(int lanes) : m_lanes(lanes) { m_sums.fill(Fnv1a::kOffsetBasis); }

  /// Bytes behind those added before, cut anywhere.
  void add(std::span<const std::byte> bytes) {
    while (m_wordBytes > 0 && !bytes.empty()) bytes = addByte(bytes);
    m_lanes == 1 ? addWords<1>(bytes) : addWords<kLanes>(bytes);
    while (!bytes.empty()) bytes = addByte(bytes);
  }
  std::uint64_t value() const {
    FileChecksum whole = *this;
    if (m_wordBytes > 0) whole.addWord(m_word);
    if (m_lanes == 1) return whole.m_sums[0];
    std::uint64_t sum = Fnv1a::kOffsetBasis;
    for (const std::uint64_t lane : whole.m_sums) sum = step(sum, lane);
    return sum;
  }

 private:
  static std::uint64_t step(std::uint64_t sum, std::uint64_t word) {
    sum = (sum ^ word) * Fnv1a::kPrime;
    return sum ^ sum >> 32;  // FNV's low bits never see its high ones; this keeps the step a bijection
  }
  static std::uint64_t wordAt(const std::byte* bytes) {
    std::uint64_t word = 0;
    for (int b = 0; b < 8; ++b) word |= std::uint64_t(bytes[b]) << (8 * b);  // compiles to a load
    return word;
  }
  void addWord(std::uint64_t word) {
    m_sums[std::size_t(m_lane)] = step(m_sums[std::size_t(m_lane)], word);
    m_lane = (m_lane + 1) % m_lanes;
  }
  std::span<const std::byte> addByte(std::span<const std::byte> bytes) {
    m_word |= std::uint64_t(bytes[0]) << (8 * m_wordBytes);
    if (++m_wordBytes == 8) {
      addWord(std::exchange(m_word, 0));
      m_wordBytes = 0;
    }
    return bytes.subspan(1);
  }
  // As many whole words as there are.
  template <std::size_t Lanes>
  void addWords(std::span<const std::byte>& bytes) {
    const std::byte* at = bytes.data();
    std::size_t words = bytes.size() / 8;
    bytes = bytes.subspan(8 * words);
    for (; words > 0 && m_lane > 0; --words, at += 8) addWord(wordAt(at));
    std::array<std::uint64_t, Lanes> sums;
    std::copy_n(m_sums.begin(), Lanes, sums.begin());
    for (; words >= Lanes; words -= Lanes, at += 8 * Lanes)
      for (std::size_t lane = 0; lane < Lanes; ++lane) sums[lane] = step(sums[lane], wordAt(at + 8 * lane));
    std::copy_n(sums.begin(), Lanes, m_sums.begin());
    for (; words > 0; --words, at += 8) addWord(wordAt(at));
  }

  int m_lanes, m_lane = 0;
  std::array<std::uint64_t, kLanes> m_sums;
  std::uint64_t m_word = 0;
  int m_wordBytes = 0;  // of m_word
};

}  // namespace rubble::base
