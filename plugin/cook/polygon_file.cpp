#include "cook/polygon_file.h"

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "rubble/error.h"

namespace rubble::cooking {
namespace {

constexpr std::string_view kOldNan = ".#";  // 1.#QNAN, -1.#IND, 1.#INF, as Microsoft's C wrote them
constexpr std::size_t kMostShown = 40;      // of a word, in a message

using Point = CGAL::Simple_cartesian<double>::Point_3;

// What a file says it holds is believed up to its own size only: every item takes a byte and more.
template <class T>
class Bounded : public std::vector<T> {
 public:
  explicit Bounded(std::size_t most = kMostCorners) : m_most(most) {}
  void resize(std::size_t size) {
    if (size > m_most) throw std::length_error("more items than bytes");
    std::vector<T>::resize(size);
  }

 private:
  static constexpr std::size_t kMostCorners = 1u << 20;  // of a polygon; beyond, it is a damaged count
  std::size_t m_most;
};
using Polygon = Bounded<std::uint32_t>;

bool read(std::istream& stream, PolygonFormat format, Bounded<Point>& points, Bounded<Polygon>& polygons) {
  const auto quiet = CGAL::parameters::verbose(false);
  switch (format) {
    case PolygonFormat::Off:
      return CGAL::IO::read_OFF(stream, points, polygons, quiet);
    case PolygonFormat::Stl:
      break;
  }
  return CGAL::IO::read_STL(stream, points, polygons, quiet);
}

constexpr std::string_view kBlanks = " \t\r\v\f";

// Takes the next word off the line; empty at its end.
std::string_view takeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

bool isNotFinite(std::string_view word) {
  if (word.find(kOldNan) != word.npos) return true;
  const std::string text(word);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() && !std::isfinite(value);
}

// Of STL what follows `vertex`: normals and names may be anything. Of OFF all up to a comment.
std::string_view firstNotFinite(std::string_view line, PolygonFormat format) {
  int coordinates = 0;
  for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
    if (format == PolygonFormat::Off && word.starts_with('#')) break;
    const bool isCoordinate = format == PolygonFormat::Off || coordinates-- > 0;
    if (isCoordinate && isNotFinite(word)) return word;
    if (word == "vertex") coordinates = 3;
  }
  return {};
}

// CGAL does not say where it stopped.
void refuseNotFinite(std::string_view text, PolygonFormat format) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view word = firstNotFinite(text.substr(0, end), format);
    if (!word.empty())
      throw Error("line " + std::to_string(number) + " has " + std::string(word.substr(0, kMostShown)) +
                  " for a coordinate; allowed: finite numbers");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

PolygonSoup parsePolygons(std::string bytes, PolygonFormat format) {
  if (bytes.find(kOldNan) != bytes.npos) refuseNotFinite(bytes, format);  // CGAL takes the 1 alone
  Bounded<Point> points(bytes.size());
  Bounded<Polygon> polygons(bytes.size());
  std::istringstream stream(std::move(bytes));
  bool isRead = false;
  try {
    isRead = read(stream, format, points, polygons);
  } catch (const std::logic_error&) {  // a length, or what CGAL did not expect
  }
  PolygonSoup soup;
  if (!isRead) {
    refuseNotFinite(stream.view(), format);
    return soup;
  }
  soup.points.reserve(points.size());
  for (const Point& p : points) soup.points.emplace_back(p.x(), p.y(), p.z());
  for (const Polygon& polygon : polygons) soup.polygons.emplace_back(polygon.begin(), polygon.end());
  return soup;
}

}  // namespace rubble::cooking
