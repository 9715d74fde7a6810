#include "base/hash.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

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

}  // namespace
}  // namespace rubble::test
