// OBJ files as CGAL can read them.
#pragma once

#include <string>

namespace rubble::cooking {

/// The vertices and faces of an OBJ file alone, one a line: lines of other kinds, blanks that are none and
/// lines that go on in the next trip CGAL's reader. Throws rubble::Error that names the line of a vertex
/// that is not three finite numbers.
std::string plainObj(const std::string& text);

}  // namespace rubble::cooking
