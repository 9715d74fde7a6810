// By hand: CGAL's reader leaves out all but the shape, trusts counts and types of the header, and cannot say
// which vertex or face is damaged.
#include "cook/ply_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "cook/ply_body.h"
#include "cook/ply_header.h"
#include "rubble/error.h"

namespace rubble::cooking {
namespace {

constexpr double kLongestList = 1u << 20;  // of a face; beyond, it is a damaged count
constexpr std::size_t kPlyUnused = ~std::size_t(0);

// Places of what is read of an element: numbers of a vertex, lists of a face.
enum PlyVertexPart : std::size_t { kPlyPlace = 0, kPlyNormal = 3, kPlyUv = 6, kPlyVertexParts = 8 };
enum PlyFacePart : std::size_t { kPlyCorners = 0, kPlyTexcoord = 1, kPlyFaceParts = 2 };

// Where each property of an element goes.
class PlySlots {
 public:
  PlySlots(const PlyElement& element, bool ofLists)
      : m_element(element), m_ofLists(ofLists), m_slots(element.properties.size(), kPlyUnused) {}

  std::size_t operator[](std::size_t property) const { return m_slots[property]; }
  bool has(std::size_t slot) const {
    return std::find(m_slots.begin(), m_slots.end(), slot) != m_slots.end();
  }

  /// The property of that name, if there is one.
  void give(std::size_t slot, const std::string& name) {
    for (std::size_t p = 0; p < m_slots.size(); ++p) {
      if (!isNamed(p, name)) continue;
      if (has(slot))
        throw Error("its PLY header names " + name + " of a " + m_element.name + " twice; allowed: once");
      m_slots[p] = slot;
    }
  }
  /// All properties of these names, from `slot` on. False where there is none of them.
  bool giveAll(std::size_t slot, const std::vector<std::string>& names) {
    std::string all, there;
    std::size_t count = 0;
    for (const std::string& name : names) {
      all += (all.empty() ? "" : ", ") + name;
      if (!isThere(name)) continue;
      there += (there.empty() ? "" : ", ") + name;
      ++count;
    }
    if (count == 0) return false;
    if (count < names.size())
      throw Error("its PLY header names " + there + " of a " + m_element.name + ", but not all of " + all +
                  "; allowed: all or none");
    for (const std::string& name : names) give(slot++, name);
    return true;
  }
  bool isThere(const std::string& name) const {
    for (std::size_t p = 0; p < m_slots.size(); ++p)
      if (isNamed(p, name)) return true;
    return false;
  }

 private:
  bool isNamed(std::size_t p, const std::string& name) const {
    return m_element.properties[p].isList == m_ofLists && m_element.properties[p].name == name;
  }

  const PlyElement& m_element;
  bool m_ofLists;
  std::vector<std::size_t> m_slots;
};

// Of several pairs the first that is whole; half a pair is damage only where there is none.
void givePlyUvs(PlySlots& slots) {
  const std::array<std::vector<std::string>, 3> kPairs = {
      {{"texture_u", "texture_v"}, {"s", "t"}, {"u", "v"}}};
  for (const auto& pair : kPairs)
    if (slots.isThere(pair[0]) && slots.isThere(pair[1])) {
      slots.giveAll(kPlyUv, pair);
      return;
    }
  for (const auto& pair : kPairs) slots.giveAll(kPlyUv, pair);
}

class PlyParser {
 public:
  explicit PlyParser(const std::string& bytes) : m_layout(readPlyHeader(bytes)), m_body(bytes, m_layout) {}

  PolygonSoup parse() {
    requireMesh();
    for (const PlyElement& element : m_layout.elements) {
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face") {
        readFaces(element);
      } else if (!element.properties.empty()) {
        const PlySlots unused(element, false);
        for (std::uint64_t i = 0; i < element.count; ++i) readItem(element, i, unused);
      }
    }
    takeLooksOfVertices();
    return std::move(m_soup);
  }

 private:
  void requireMesh() const {
    const auto count = [&](const char* name) {
      return std::count_if(m_layout.elements.begin(), m_layout.elements.end(),
                           [&](const PlyElement& element) { return element.name == name; });
    };
    if (count("vertex") != 1 || count("face") != 1) refuseHeader();
  }
  [[noreturn]] static void refuseHeader() {
    throw Error(
        "its PLY header names no mesh; allowed: a format, vertices with x, y and z, and faces with "
        "vertex_indices, each once");
  }

  // "nx of vertex 3".
  static std::string nameOf(const PlyProperty& property, const PlyElement& element, std::uint64_t item) {
    return property.name + " of " + element.name + ' ' + std::to_string(item);
  }

  double take(PlyType type, const PlyProperty& property, const PlyElement& element, std::uint64_t item) {
    double number = 0;
    if (m_body.take(type, number)) return number;
    if (m_body.hasEnded())
      throw Error("ends before " + nameOf(property, element, item) +
                  "; allowed: all that its PLY header names, " + std::to_string(element.count) + " of " +
                  element.name);
    throw Error(nameOf(property, element, item) + " is no number; allowed: numbers that a double holds");
  }

  void readItem(const PlyElement& element, std::uint64_t item, const PlySlots& slots) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.isList) {
        readList(property, element, item, slots[p]);
      } else {
        const double number = take(property.type, property, element, item);
        if (slots[p] != kPlyUnused) m_numbers[slots[p]] = number;
      }
    }
  }

  void readList(const PlyProperty& property, const PlyElement& element, std::uint64_t item,
                std::size_t slot) {
    const double count = take(property.countType, property, element, item);
    if (!(count >= 0) || count != std::floor(count) || (slot != kPlyUnused && count > kLongestList))
      throw Error(nameOf(property, element, item) + " is a list of " + base::numberText(count) +
                  "; allowed: 0 to " + base::numberText(kLongestList));
    if (slot != kPlyUnused) m_lists[slot].clear();
    for (double k = 0; k < count; ++k) {
      const double number = take(property.type, property, element, item);
      if (slot != kPlyUnused) m_lists[slot].push_back(number);
    }
  }

  void readVertices(const PlyElement& element) {
    PlySlots slots(element, false);
    for (const std::size_t axis : {0u, 1u, 2u}) slots.give(kPlyPlace + axis, std::string(1, "xyz"[axis]));
    if (!slots.has(kPlyPlace) || !slots.has(kPlyPlace + 1) || !slots.has(kPlyPlace + 2)) refuseHeader();
    slots.giveAll(kPlyNormal, {"nx", "ny", "nz"});
    givePlyUvs(slots);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      readItem(element, i, slots);
      m_soup.points.emplace_back(m_numbers[kPlyPlace], m_numbers[kPlyPlace + 1], m_numbers[kPlyPlace + 2]);
      if (slots.has(kPlyNormal))
        requireFinite(
            m_soup.normals.emplace_back(float(m_numbers[kPlyNormal]), float(m_numbers[kPlyNormal + 1]),
                                        float(m_numbers[kPlyNormal + 2])),
            "normal", element, i);
      if (slots.has(kPlyUv))
        requireFinite(m_vertexUvs.emplace_back(float(m_numbers[kPlyUv]), float(m_numbers[kPlyUv + 1])),
                      "texture coordinate", element, i);
    }
  }

  void readFaces(const PlyElement& element) {
    PlySlots slots(element, true);
    for (const char* name : {"vertex_indices", "vertex_index"}) slots.give(kPlyCorners, name);
    if (!slots.has(kPlyCorners)) refuseHeader();
    slots.give(kPlyTexcoord, "texcoord");
    for (std::uint64_t f = 0; f < element.count; ++f) {
      readItem(element, f, slots);
      auto& polygon = m_soup.polygons.emplace_back();
      for (const double corner : m_lists[kPlyCorners]) {
        if (!(corner >= 0) || !(corner < kNoLook) || corner != std::floor(corner))
          throw Error("face " + std::to_string(f) +
                      " names a vertex that is not there; allowed: those of the file, counted from 0");
        polygon.push_back(std::uint32_t(corner));
      }
      if (slots.has(kPlyTexcoord)) takeTexcoord(element, f);
    }
  }

  // The face's own, a pair a corner, or none.
  void takeTexcoord(const PlyElement& element, std::uint64_t f) {
    const std::vector<double>& list = m_lists[kPlyTexcoord];
    const std::size_t corners = m_soup.polygons.back().size();
    if (list.empty()) return;
    if (list.size() != 2 * corners)
      throw Error("texcoord of face " + std::to_string(f) + " has " + std::to_string(list.size()) +
                  " numbers for " + std::to_string(corners) + " corners; allowed: none, or two a corner");
    m_soup.looks.resize(m_soup.polygons.size());
    for (std::size_t k = 0; k < corners; ++k) {
      m_soup.looks.back().push_back({.uv = std::uint32_t(m_soup.uvs.size())});
      requireFinite(m_soup.uvs.emplace_back(float(list[2 * k]), float(list[2 * k + 1])), "texture coordinate",
                    element, f);
    }
  }

  template <class Vector>
  static void requireFinite(const Vector& vector, const char* what, const PlyElement& element,
                            std::uint64_t item) {
    if (!vector.allFinite())
      throw Error("a " + std::string(what) + " of " + element.name + ' ' + std::to_string(item) +
                  " is not finite; allowed: numbers that a float holds");
  }

  // Corners take over what their vertex has, texture coordinates where their face has none. Faces may come
  // before vertices, so this comes last.
  void takeLooksOfVertices() {
    const bool hasNormals = !m_soup.normals.empty(), hasUvs = !m_vertexUvs.empty();
    if (!m_soup.looks.empty() || hasNormals || hasUvs) m_soup.looks.resize(m_soup.polygons.size());
    if (!hasNormals && !hasUvs) return;
    const auto first = std::uint32_t(m_soup.uvs.size());
    m_soup.uvs.insert(m_soup.uvs.end(), m_vertexUvs.begin(), m_vertexUvs.end());
    for (std::size_t f = 0; f < m_soup.looks.size(); ++f) {
      const std::vector<std::uint32_t>& polygon = m_soup.polygons[f];
      m_soup.looks[f].resize(polygon.size());
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        CornerLook& look = m_soup.looks[f][k];
        if (hasNormals) look.normal = polygon[k];
        if (hasUvs && look.uv == kNoLook) look.uv = first + polygon[k];
      }
    }
  }

  PlyLayout m_layout;
  PlyBody m_body;
  PolygonSoup m_soup;
  std::vector<Eigen::Vector2f> m_vertexUvs;
  std::array<double, kPlyVertexParts> m_numbers{};  // of the item that is read
  std::array<std::vector<double>, kPlyFaceParts> m_lists;
};

}  // namespace

PolygonSoup parsePly(const std::string& bytes) {
  return PlyParser(bytes).parse();
}

}  // namespace rubble::cooking
