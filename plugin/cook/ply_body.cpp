#include "cook/ply_body.h"

#include <algorithm>
#include <bit>
#include <charconv>

namespace rubble::cooking {
namespace {

std::size_t plySizeOf(PlyType type) {
  switch (type) {
    case PlyType::Char:
    case PlyType::UChar:
      return 1;
    case PlyType::Short:
    case PlyType::UShort:
      return 2;
    case PlyType::Int:
    case PlyType::UInt:
    case PlyType::Float:
      return 4;
    case PlyType::Double:
      break;
  }
  return 8;
}

double plyNumberOf(std::uint64_t bits, PlyType type) {
  switch (type) {
    case PlyType::Char:
      return double(std::int8_t(bits));
    case PlyType::Short:
      return double(std::int16_t(bits));
    case PlyType::Int:
      return double(std::int32_t(bits));
    case PlyType::Float:
      return double(std::bit_cast<float>(std::uint32_t(bits)));
    case PlyType::Double:
      return std::bit_cast<double>(bits);
    case PlyType::UChar:
    case PlyType::UShort:
    case PlyType::UInt:
      break;
  }
  return double(bits);
}

}  // namespace

bool PlyBody::take(PlyType type, double& number) {
  if (m_format != PlyFormat::Ascii) return takeBytes(type, number);
  if (!takeText(number)) return false;
  if (type == PlyType::Float) number = double(float(number));  // the same solid as from bytes
  return true;
}

bool PlyBody::takeText(double& number) {
  constexpr const char* kBlanks = " \t\r\n";
  m_rest.remove_prefix(std::min(m_rest.find_first_not_of(kBlanks), m_rest.size()));
  m_hasEnded = m_rest.empty();
  std::string_view word = m_rest.substr(0, m_rest.find_first_of(kBlanks));
  m_rest.remove_prefix(word.size());
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [next, error] = std::from_chars(word.data(), end, number);
  return !word.empty() && error == std::errc() && next == end;
}

bool PlyBody::takeBytes(PlyType type, double& number) {
  const std::size_t size = plySizeOf(type);
  m_hasEnded = m_rest.size() < size;
  if (m_hasEnded) return false;
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < size; ++k)
    bits = bits << 8 | std::uint8_t(m_rest[m_format == PlyFormat::BigEndian ? k : size - 1 - k]);
  m_rest.remove_prefix(size);
  number = plyNumberOf(bits, type);
  return true;
}

}  // namespace rubble::cooking
