// Tables of numbers in Markdown.
#pragma once

#include <string>
#include <vector>

namespace rubble::demo {

/// The cells of a table, row by row; all rows are of one length.
using TextRows = std::vector<std::vector<std::string>>;

/// The first row is the heading.
std::string markdownTable(const TextRows& rows);

/// Three significant digits, without an exponent from 1 to a million.
std::string rounded(double value);

}  // namespace rubble::demo
