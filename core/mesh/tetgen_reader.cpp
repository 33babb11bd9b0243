#include "core/mesh/tetgen_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/mesh/file_cursor.h"

namespace flexcast {
namespace {

// The lines with data of a TetGen file, as words. What is missing on a line is an empty word.
class TetgenLines {
 public:
  static constexpr std::size_t most_words = 5;  // an element with its number; what follows is of no interest

  explicit TetgenLines(const FileContent& file) : cursor_(file) {}

  FileCursor& cursor() { return cursor_; }

  // False at the end of the file.
  bool next() {
    while (!cursor_.failed() && !cursor_.at_end()) {
      split(cursor_.line());
      if (!words_[0].empty()) return true;
    }
    return false;
  }

  std::int64_t integer(std::size_t column, const std::string& what) {
    const auto value = parse_integer(words_[column]);
    if (!value) fail_at(column, what + ", a whole number,");
    return value.value_or(0);
  }

  double number(std::size_t column, const std::string& what) {
    const auto value = parse_number(words_[column]);
    if (!value) fail_at(column, what + ", a number,");
    return value.value_or(0.0);
  }

  bool has(std::size_t column) const { return !words_[column].empty(); }

  // The first line: how many records follow.
  std::int64_t count(const char* records) {
    const std::string what = std::string("the number of ") + records;
    if (next()) return integer(0, what);
    cursor_.fail("the file ends where " + what + " is expected");
    return 0;
  }

  bool next_record(std::int64_t record, std::int64_t announced, const char* records) {
    if (next()) return true;
    cursor_.fail("the file ends after " + std::to_string(record) + " of " + std::to_string(announced) + " " + records);
    return false;
  }

  void expect_end(std::int64_t announced, const char* records) {
    if (next()) cursor_.fail("there is more than the " + std::to_string(announced) + " " + records + " announced");
  }

 private:
  void fail_at(std::size_t column, const std::string& expected) {
    const std::string found = has(column) ? "found " + quoted(words_[column]) : "the line ends";
    cursor_.fail(found + " where " + expected + " is expected");
  }

  void split(std::string_view line) {
    constexpr std::string_view white_space = " \t\r\v\f";
    words_.fill({});
    line = line.substr(0, line.find('#'));
    for (std::string_view& word : words_) {
      line.remove_prefix(std::min(line.find_first_not_of(white_space), line.size()));
      word = line.substr(0, line.find_first_of(white_space));
      line.remove_prefix(word.size());
    }
  }

  FileCursor cursor_;
  std::array<std::string_view, most_words> words_;
};

Result<void> read_nodes(const FileContent& file, NumberedMesh& mesh) {
  TetgenLines lines(file);
  FileCursor& cursor = lines.cursor();

  const std::int64_t count = lines.count("nodes");
  if (!cursor.failed() && lines.has(1) && lines.integer(1, "the dimension") != 3) {
    cursor.fail("has nodes of dimension " + std::to_string(lines.integer(1, "the dimension")) + "; 3 is needed");
  }
  cursor.check_count(count, 7, "nodes");  // "0 0 0 0" is the shortest
  if (cursor.failed()) return cursor.error();

  mesh.nodes.reserve(static_cast<std::size_t>(count));
  mesh.node_numbers.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count && lines.next_record(i, count, "nodes"); ++i) {
    const std::int64_t number = lines.integer(0, "a node number");
    if (i == 0 && number != 0 && number != 1) {
      cursor.fail("the first node has number " + std::to_string(number) + "; 0 and 1 are allowed");
    } else if (i > 0 && number != mesh.node_numbers[0] + i) {
      cursor.fail("found node " + std::to_string(number) + " where node " + std::to_string(mesh.node_numbers[0] + i) +
                  " is expected");
    }
    mesh.node_numbers.push_back(number);
    const double x = lines.number(1, "a coordinate");
    const double y = lines.number(2, "a coordinate");
    const double z = lines.number(3, "a coordinate");
    mesh.nodes.emplace_back(x, y, z);
  }
  lines.expect_end(count, "nodes");
  if (cursor.failed()) return cursor.error();
  return {};
}

Result<void> read_elements(const FileContent& file, NumberedMesh& mesh) {
  TetgenLines lines(file);
  FileCursor& cursor = lines.cursor();

  const std::int64_t count = lines.count("elements");
  const std::int64_t vertices = lines.has(1) ? lines.integer(1, "the number of nodes per element") : 4;
  if (vertices == 10) {
    cursor.fail("has 10-node tetrahedra; only 4-node tetrahedra are supported");
  } else if (vertices != 4) {
    cursor.fail("has " + std::to_string(vertices) + " nodes per element; only 4-node tetrahedra are supported");
  }
  cursor.check_count(count, 9, "elements");  // "0 0 0 0 0" is the shortest
  if (cursor.failed()) return cursor.error();

  mesh.elements.reserve(static_cast<std::size_t>(count));
  mesh.element_numbers.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count && lines.next_record(i, count, "elements"); ++i) {
    mesh.element_numbers.push_back(lines.integer(0, "an element number"));
    std::array<std::int64_t, 4> element{};
    for (std::size_t vertex = 0; vertex < 4; ++vertex) element[vertex] = lines.integer(vertex + 1, "a node number");
    mesh.elements.push_back(element);
  }
  lines.expect_end(count, "elements");
  if (cursor.failed()) return cursor.error();
  return {};
}

}  // namespace

Result<NumberedMesh> parse_tetgen(const FileContent& node_file, const FileContent& ele_file) {
  NumberedMesh mesh;
  mesh.node_file = node_file.name;
  mesh.element_file = ele_file.name;
  if (auto nodes = read_nodes(node_file, mesh); !nodes) return nodes.error();
  if (auto elements = read_elements(ele_file, mesh); !elements) return elements.error();
  return mesh;
}

}  // namespace flexcast
