// Columns of numbers from a CSV file: the first row names them, lines that begin with # are comments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace flexcast {

// One vector a name, in this order, with a value a row; not a number where the cell is empty. Columns that are not
// asked for may hold anything. Errors name the file, and the column and the columns there are, or the line.
Result<std::vector<std::vector<double>>> read_csv_columns(const std::filesystem::path& path,
                                                          const std::vector<std::string>& names);

}  // namespace flexcast
