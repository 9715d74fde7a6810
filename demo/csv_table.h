// Tables as comma-separated values.
#pragma once

#include <string>

#include "demo/markdown_table.h"

namespace rubble::demo {

/// One line a row; a cell that holds a comma or a quote is quoted.
std::string csvTable(const TextRows& rows);

}  // namespace rubble::demo
