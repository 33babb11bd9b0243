#include "core/mesh/gmsh_reader.h"

#include <string>
#include <string_view>
#include <utility>

#include "core/mesh/file_cursor.h"
#include "core/mesh/gmsh_element_types.h"

namespace flexcast {
namespace {

// The fewest bytes of a node or an element in ASCII: single digits, single spaces.
constexpr std::uint64_t ascii_node_bytes = 8;
constexpr std::uint64_t ascii_element_bytes = 4;

class GmshReader {
 public:
  explicit GmshReader(const FileContent& file) : cursor_(file) {}

  Result<NumberedMesh> read() {
    while (!cursor_.failed()) {
      cursor_.skip_white_space();
      if (cursor_.at_end()) break;
      read_section(cursor_.word("a section"));
    }
    if (cursor_.failed()) return cursor_.error();
    for (const auto& [found, section] : {std::pair(version_ != 0, "$MeshFormat"), std::pair(has_nodes_, "$Nodes"),
                                         std::pair(has_elements_, "$Elements")}) {
      if (!found) return Error{cursor_.name() + ": has no " + section + " section"};
    }
    mesh_.node_file = mesh_.element_file = cursor_.name();
    return std::move(mesh_);
  }

 private:
  void read_section(std::string_view section) {
    if (!section.starts_with('$')) {
      cursor_.fail("found " + quoted(section) + " where a section of a Gmsh file, such as $Nodes, is expected");
    } else if (section == "$MeshFormat") {
      read_format();
    } else if (section == "$Nodes" || section == "$Elements") {
      read_mesh_section(section == "$Nodes");
    } else if (section == "$ParametricNodes") {
      cursor_.fail("parametric nodes are not supported; save the mesh without them");
    } else if (section == "$NOD") {
      cursor_.fail("Gmsh format version 1 is not supported; 2.2 and 4.1 are");
    } else {
      cursor_.skip_past_line("$End" + std::string(section.substr(1)));
    }
  }

  void read_format() {
    if (version_ != 0) return cursor_.fail("there is a second $MeshFormat section");
    const std::string_view version = cursor_.word("a version");
    const auto number = parse_number(version);
    if (number != 2.2 && number != 4.1) {
      return cursor_.fail("Gmsh format version " + quoted(version) + " is not supported; 2.2 and 4.1 are");
    }
    const std::int64_t file_type = cursor_.integer("a file type");
    if (file_type != 0 && file_type != 1) {
      return cursor_.fail("file type " + std::to_string(file_type) + " is neither 0 (ASCII) nor 1 (binary)");
    }
    const std::int64_t data_size = cursor_.integer("a data size");
    if (data_size != 8) {
      return cursor_.fail("data size " + std::to_string(data_size) + " is not supported; 8 is");
    }
    version_ = number == 2.2 ? 2 : 4;
    binary_ = file_type == 1;
    if (binary_) read_byte_order();
    cursor_.expect_word("$EndMeshFormat");
  }

  void read_byte_order() {
    cursor_.line();
    cursor_.count_bytes();
    const auto one = cursor_.raw<std::int32_t>("the byte order mark");
    if (one == 0x01000000) {
      cursor_.fail("was written on a machine with the other byte order; convert it with gmsh first");
    } else if (one != 1) {
      cursor_.fail("the byte order mark is " + std::to_string(one) + "; 1 is expected");
    }
  }

  void read_mesh_section(bool nodes) {
    bool& seen = nodes ? has_nodes_ : has_elements_;
    const std::string name = nodes ? "$Nodes" : "$Elements";
    if (version_ == 0) return cursor_.fail(name + " stands before $MeshFormat");
    if (seen) return cursor_.fail("there is a second " + name + " section");
    seen = true;
    if (version_ == 2) {
      const std::int64_t count = cursor_.integer(nodes ? "the number of nodes" : "the number of elements");
      if (binary_) cursor_.line();
      nodes ? read_nodes_2(count) : read_elements_2(count);
    } else {
      if (binary_) cursor_.line();
      nodes ? read_nodes_4() : read_elements_4();
    }
    cursor_.expect_word("$End" + name.substr(1));
  }

  void read_nodes_2(std::int64_t count) {
    if (!reserve_nodes(count, binary_ ? 28 : ascii_node_bytes)) return;
    for (std::int64_t i = 0; i < count && !cursor_.failed(); ++i) {
      mesh_.node_numbers.push_back(integer32("a node number"));
      mesh_.nodes.push_back(coordinates());
    }
  }

  // Blocks, each first all numbers, then all coordinates.
  void read_nodes_4() {
    const std::int64_t blocks = integer64("the number of node blocks");
    const std::int64_t count = integer64("the number of nodes");
    skip_numbers(2);  // smallest and largest node number
    if (!reserve_nodes(count, binary_ ? 32 : ascii_node_bytes)) return;
    std::int64_t left = count;
    for (std::int64_t block = 0; block < blocks && !cursor_.failed(); ++block) {
      const std::int64_t dimension = integer32("the dimension of a node block");
      integer32("the entity of a node block");
      const bool parametric = integer32("0 or 1 for parametric nodes") != 0;
      if (dimension < 0 || dimension > 3) {
        return cursor_.fail("a block of nodes has dimension " + std::to_string(dimension) + "; 0 to 3 are allowed");
      }
      const std::int64_t in_block = integer64("the number of nodes in the block");
      if (!take_block(in_block, left, "nodes")) return;
      for (std::int64_t i = 0; i < in_block && !cursor_.failed(); ++i) {
        mesh_.node_numbers.push_back(integer64("a node number"));
      }
      for (std::int64_t i = 0; i < in_block && !cursor_.failed(); ++i) {
        mesh_.nodes.push_back(coordinates());
        for (std::int64_t u = 0; parametric && u < dimension; ++u) real("a parametric coordinate");
      }
    }
    check_complete(left, count, "nodes");
  }

  void read_elements_2(std::int64_t count) {
    cursor_.check_count(count, ascii_element_bytes, "elements");
    std::int64_t left = count;
    while (left > 0 && !cursor_.failed()) {
      // Binary elements come in blocks with one header, ASCII elements each with their own.
      std::int64_t number = binary_ ? 0 : integer32("an element number");
      const GmshElementType* type = element_type();
      const std::int64_t in_block = binary_ ? integer32("the number of elements in the block") : 1;
      const std::int64_t tags = integer32("the number of tags");
      cursor_.check_count(tags, binary_ ? 4 : 2, "tags");
      if (!take_block(in_block, left, "elements")) return;
      for (std::int64_t i = 0; i < in_block && !cursor_.failed(); ++i) {
        if (binary_) number = integer32("an element number");
        for (std::int64_t tag = 0; tag < tags && !cursor_.failed(); ++tag) integer32("a tag");
        read_element(*type, number, &GmshReader::integer32);
      }
    }
  }

  void read_elements_4() {
    const std::int64_t blocks = integer64("the number of element blocks");
    const std::int64_t count = integer64("the number of elements");
    skip_numbers(2);  // smallest and largest element number
    cursor_.check_count(count, binary_ ? 16 : ascii_element_bytes, "elements");
    std::int64_t left = count;
    for (std::int64_t block = 0; block < blocks && !cursor_.failed(); ++block) {
      integer32("the dimension of an element block");
      integer32("the entity of an element block");
      const GmshElementType* type = element_type();
      const std::int64_t in_block = integer64("the number of elements in the block");
      if (!take_block(in_block, left, "elements")) return;
      for (std::int64_t i = 0; i < in_block && !cursor_.failed(); ++i) {
        const std::int64_t number = integer64("an element number");
        read_element(*type, number, &GmshReader::integer64);
      }
    }
    check_complete(left, count, "elements");
  }

  void read_element(const GmshElementType& type, std::int64_t number,
                    std::int64_t (GmshReader::*read_integer)(const char*)) {
    if (type.dimension == 3 && type.number != gmsh_tetrahedron && !cursor_.failed()) {
      return cursor_.fail("element " + std::to_string(number) + ", a volume element of type '" + type.name +
                          "', is not supported; only the 4-node tetrahedron is");
    }
    std::array<std::int64_t, 4> vertices{};
    for (int i = 0; i < type.nodes && !cursor_.failed(); ++i) {
      const std::int64_t vertex = (this->*read_integer)("a node number");
      if (i < 4) vertices[i] = vertex;
    }
    if (cursor_.failed() || type.number != gmsh_tetrahedron) return;
    mesh_.elements.push_back(vertices);
    mesh_.element_numbers.push_back(number);
  }

  // Null only after a failure.
  const GmshElementType* element_type() {
    const std::int64_t number = integer32("an element type");
    const GmshElementType* type = find_gmsh_element_type(number);
    if (type == nullptr) cursor_.fail("element type " + std::to_string(number) + " is not known");
    return type;
  }

  bool reserve_nodes(std::int64_t count, std::uint64_t bytes_each) {
    cursor_.check_count(count, bytes_each, "nodes");
    if (cursor_.failed()) return false;
    mesh_.nodes.reserve(static_cast<std::size_t>(count));
    mesh_.node_numbers.reserve(static_cast<std::size_t>(count));
    return true;
  }

  // False after a failure: then nothing of the block may be used.
  bool take_block(std::int64_t in_block, std::int64_t& left, const char* what) {
    if (in_block < 0 || in_block > left) {
      cursor_.fail("a block has " + std::to_string(in_block) + " " + what + " where 0 to " + std::to_string(left) +
                   " are left of those announced");
    }
    if (cursor_.failed()) return false;
    left -= in_block;
    return true;
  }

  void check_complete(std::int64_t left, std::int64_t count, const char* what) {
    if (left == 0) return;
    cursor_.fail("the blocks have " + std::to_string(left) + " " + what + " less than the " + std::to_string(count) +
                 " announced");
  }

  std::int64_t integer32(const char* expected) {
    return binary_ ? cursor_.raw<std::int32_t>(expected) : cursor_.integer(expected);
  }
  std::int64_t integer64(const char* expected) {
    return binary_ ? cursor_.raw<std::int64_t>(expected) : cursor_.integer(expected);
  }
  double real(const char* expected) { return binary_ ? cursor_.raw<double>(expected) : cursor_.number(expected); }
  void skip_numbers(int count) {
    for (int i = 0; i < count; ++i) integer64("the range of the numbers");
  }
  Vec3 coordinates() {
    const double x = real("a coordinate");
    const double y = real("a coordinate");
    const double z = real("a coordinate");
    return {x, y, z};
  }

  FileCursor cursor_;
  int version_ = 0;  // 2 or 4 once the header is read
  bool binary_ = false;
  bool has_nodes_ = false;
  bool has_elements_ = false;
  NumberedMesh mesh_;
};

}  // namespace

Result<NumberedMesh> parse_gmsh(const FileContent& file) {
  return GmshReader(file).read();
}

}  // namespace flexcast
