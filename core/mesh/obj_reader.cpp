#include "core/mesh/obj_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace flexcast {
namespace {

constexpr std::string_view white_space = " \t\r\v\f";

// What says nothing about the shape.
constexpr std::array ignored_keywords = {
    "vt",     "vn",    "vp",       "g",        "o",   "s", "mg", "usemtl",     "mtllib",    "usemap",
    "maplib", "bevel", "c_interp", "d_interp", "lod", "p", "l",  "shadow_obj", "trace_obj",
};
constexpr std::array free_form_keywords = {"cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",  "parm",
                                           "trim",   "hole", "scrv", "sp",   "end",  "con",   "stech", "ctech"};

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<const char*, N>& list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// The next word of the line, which is shortened by it.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(white_space), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(white_space));
  line.remove_prefix(word.size());
  return word;
}

class ObjReader {
 public:
  explicit ObjReader(const FileContent& file) : cursor_(file) { surface_.file = file.name; }

  Result<NumberedSurface> read() {
    while (!cursor_.failed() && !cursor_.at_end()) read_statement();
    if (cursor_.failed()) return cursor_.error();
    return std::move(surface_);
  }

 private:
  void read_statement() {
    std::string_view line = cursor_.line();
    line_ = cursor_.read_line();
    std::string joined;
    if (line.ends_with('\\')) line = joined = join(line);
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = take_word(line);
    if (keyword == "v") return read_vertex(line);
    if (keyword == "f" || keyword == "fo") return read_face(line);
    if (keyword.empty() || is_one_of(keyword, ignored_keywords)) return;
    if (is_one_of(keyword, free_form_keywords)) {
      return cursor_.fail("free-form geometry (" + quoted(keyword) + ") is not supported; only faces are");
    }
    cursor_.fail("found " + quoted(keyword) + " where a statement of a Wavefront file, such as v or f, is expected");
  }

  // With the lines that it goes on in.
  std::string join(std::string_view line) {
    std::string joined(line);
    while (joined.ends_with('\\') && !cursor_.at_end()) {
      joined.back() = ' ';
      joined += cursor_.line();
    }
    return joined;
  }

  void read_vertex(std::string_view line) {
    Vec3 node;
    for (double& x : node) {
      const std::string_view word = take_word(line);
      const auto value = parse_number(word);
      if (!value) return fail_at(word, "a coordinate, a number,");
      x = *value;
    }
    // A weight, or a colour of three or four parts.
    for (int more = 0; more < 5; ++more) {
      const std::string_view word = take_word(line);
      if (word.empty()) break;
      if (more == 4) return fail_at(word, "the end of a vertex");
      if (!parse_number(word)) return fail_at(word, "a weight or a colour, a number,");
    }
    surface_.nodes.push_back(node);
  }

  void read_face(std::string_view line) {
    NumberedSurface::Face face{surface_.corners.size(), 0, line_};
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const auto node = parse_corner(word);
      if (!node) return fail_at(word, "a corner of a face, such as 7, 7/1, 7//1 or 7/1/1,");
      if (*node == 0) return cursor_.fail("a face names node 0; numbers begin with 1, or with -1 from the end");
      const bool counts_back = *node < 0;
      surface_.corners.push_back(counts_back ? static_cast<std::int64_t>(surface_.nodes.size()) + 1 + *node : *node);
    }
    face.count = surface_.corners.size() - face.first;
    if (face.count < 3) return cursor_.fail("a face has " + std::to_string(face.count) + " corners; 3 are needed");
    surface_.faces.push_back(face);
  }

  // The number of the vertex, if the others are numbers or left out.
  static std::optional<std::int64_t> parse_corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    const auto node = parse_integer(word.substr(0, slash));
    if (!node || slash == std::string_view::npos) return node;
    std::string_view rest = word.substr(slash + 1);
    const std::size_t second = rest.find('/');
    const std::string_view texture = rest.substr(0, second);
    if (!texture.empty() && !parse_integer(texture)) return std::nullopt;
    if (second != std::string_view::npos && !parse_integer(rest.substr(second + 1))) return std::nullopt;
    return texture.empty() && second == std::string_view::npos ? std::nullopt : node;
  }

  void fail_at(std::string_view word, const std::string& expected) {
    cursor_.fail((word.empty() ? "the line ends" : "found " + quoted(word)) + " where " + expected + " is expected");
  }

  FileCursor cursor_;
  std::int64_t line_ = 0;  // where the statement begins
  NumberedSurface surface_;
};

}  // namespace

Result<NumberedSurface> parse_obj(const FileContent& file) {
  return ObjReader(file).read();
}

}  // namespace flexcast
