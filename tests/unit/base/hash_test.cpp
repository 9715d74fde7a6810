#include "base/hash.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace rubble::test {
namespace {

// From the test vectors of the reference implementation (isthe.com/chongo/tech/comp/fnv).
TEST(Fnv1a, MatchesThePublishedValues) {
  base::Fnv1a a;
  a.add('a');
  EXPECT_EQ(a.value(), 0xaf63dc4c8601ec8cu);
  base::Fnv1a foobar;
  for (const char c : {'f', 'o', 'o', 'b', 'a', 'r'}) foobar.add(c);
  EXPECT_EQ(foobar.value(), 0x85944171f73967e8u);
}

TEST(Fnv1a, TakesANumberAsItsBytes) {
  base::Fnv1a number, bytes;
  number.add(std::uint32_t{0x64636261});  // "abcd" on a little-endian machine
  for (const char c : {'a', 'b', 'c', 'd'}) bytes.add(c);
  EXPECT_EQ(number.value(), bytes.value());
  base::Fnv1a vector, numbers;
  vector.addAll(Eigen::Vector3d(1, 2, 3));
  for (const double x : {1.0, 2.0, 3.0}) numbers.add(x);
  EXPECT_EQ(vector.value(), numbers.value());
}

// 37 words and a rest of 5 bytes: every lane has more than four, and not all as many.
std::vector<std::byte> someBytes() {
  std::vector<std::byte> bytes;
  for (unsigned k = 0; k < 37 * 8 + 5; ++k) bytes.push_back(std::byte(k * k + 3 * k + 1));
  return bytes;
}

std::uint64_t sumOf(int lanes, std::span<const std::byte> bytes) {
  base::FileChecksum sum(lanes);
  sum.add(bytes);
  return sum.value();
}

TEST(FileChecksum, OfEightLanesIsThatOfTheLanes) {
  const std::vector<std::byte> bytes = someBytes();
  std::array<std::vector<std::byte>, 8> lanes;
  for (std::size_t k = 0; k < bytes.size(); ++k) lanes[k / 8 % 8].push_back(bytes[k]);
  std::vector<std::byte> sums;
  for (const std::vector<std::byte>& lane : lanes) {
    const std::uint64_t sum = sumOf(1, lane);
    for (int b = 0; b < 8; ++b) sums.push_back(std::byte(sum >> (8 * b)));
  }
  EXPECT_EQ(sumOf(8, bytes), sumOf(1, sums));
}

TEST(FileChecksum, DoesNotDependOnTheCuts) {
  const std::vector<std::byte> bytes = someBytes();
  const std::span<const std::byte> all(bytes);
  for (const int lanes : {1, 8})
    for (std::size_t a = 0; a <= bytes.size(); a += 3)
      for (std::size_t b = a; b <= bytes.size(); b += 17) {
        base::FileChecksum sum(lanes);
        sum.add(all.first(a)), sum.add(all.subspan(a, b - a)), sum.add(all.subspan(b));
        ASSERT_EQ(sum.value(), sumOf(lanes, bytes)) << lanes << ' ' << a << ' ' << b;
      }
}

TEST(FileChecksum, SeesEveryBitAndWordsThatChangePlaces) {
  const std::vector<std::byte> bytes = someBytes();
  for (const int lanes : {1, 8}) {
    const std::uint64_t whole = sumOf(lanes, bytes);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::vector<std::byte> other = bytes;
      other[bit / 8] ^= std::byte(1 << bit % 8);
      EXPECT_NE(sumOf(lanes, other), whole) << bit;
    }
    for (const std::size_t apart : {1, 8})
      for (std::size_t word = 0; word + apart < bytes.size() / 8; ++word) {
        std::vector<std::byte> other = bytes;
        std::swap_ranges(&other[8 * word], &other[8 * word] + 8, &other[8 * (word + apart)]);
        EXPECT_NE(sumOf(lanes, other), whole) << word;
      }
  }
}

}  // namespace
}  // namespace rubble::test
