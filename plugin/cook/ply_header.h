// PLY files as CGAL can read them.
#pragma once

#include <string>

namespace rubble::cooking {

/// The bytes with a header that names what a mesh needs and nothing else: CGAL's reader trusts headers, and
/// wrong ones crash it. Throws rubble::Error that names the line which is wrong and what is allowed.
std::string plainPly(const std::string& bytes);

}  // namespace rubble::cooking
