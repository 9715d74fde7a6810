#include "cook/polygon_file.h"

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <sstream>
#include <stdexcept>
#include <utility>

namespace rubble::cooking {
namespace {

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

}  // namespace

PolygonSoup parsePolygons(std::string bytes, PolygonFormat format) {
  Bounded<Point> points(bytes.size());
  Bounded<Polygon> polygons(bytes.size());
  std::istringstream stream(std::move(bytes));
  PolygonSoup soup;
  try {
    if (!read(stream, format, points, polygons)) return soup;
  } catch (const std::logic_error&) {  // a length, or what CGAL did not expect
    return soup;
  }
  soup.points.reserve(points.size());
  for (const Point& p : points) soup.points.emplace_back(p.x(), p.y(), p.z());
  for (const Polygon& polygon : polygons) soup.polygons.emplace_back(polygon.begin(), polygon.end());
  return soup;
}

}  // namespace rubble::cooking
