#include "core/lab/plot/csv_table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

namespace flexcast {
namespace {

using Cells = std::vector<std::string>;

std::string trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Commas within quotes do not part cells; two quotes within quotes are one.
Cells split(const std::string& line) {
  Cells cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  for (std::string& cell : cells) cell = trim(cell);
  return cells;
}

// Nothing: the cell is neither empty nor a number.
std::optional<double> read_number(const std::string& cell) {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return value;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::quiet_NaN();
  return error == std::errc() && end == cell.data() + cell.size() ? std::optional(value) : std::nullopt;
}

// The next line that is neither empty nor a comment, without its end.
bool read_line(std::istream& in, std::string& line, std::int64_t& number) {
  while (std::getline(in, line)) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (!line.empty() && line[0] != '#') return true;
  }
  return false;
}

std::string join(const Cells& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Result<std::vector<std::vector<double>>> read_csv_columns(const std::filesystem::path& path,
                                                          const std::vector<std::string>& names) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::int64_t number = 0;
  if (!file) return Error{path.string() + ": cannot be read"};
  if (!read_line(file, line, number)) return Error{path.string() + ": no row that names the columns"};
  const Cells header = split(line);
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end())
      return Error{path.string() + ": no column " + name + " (there are: " + join(header) + ")"};
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  std::vector<std::vector<double>> columns(names.size());
  while (read_line(file, line, number)) {
    const std::string where = path.string() + ":" + std::to_string(number) + ": ";
    const Cells cells = split(line);
    if (cells.size() != header.size()) {
      return Error{where + std::to_string(cells.size()) + " cells (allowed: " + std::to_string(header.size()) +
                   ", one for each column)"};
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto value = read_number(cells[places[i]]);
      if (!value) return Error{where + names[i] + " = " + cells[places[i]] + " (allowed: a number, or an empty cell)"};
      columns[i].push_back(*value);
    }
  }
  if (file.bad()) return Error{path.string() + ": cannot be read"};
  return columns;
}

}  // namespace flexcast
