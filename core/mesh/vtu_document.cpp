#include "core/mesh/vtu_document.h"

#include <algorithm>
#include <limits>

namespace flexcast {
namespace {

constexpr std::string_view xml_space = " \t\r\n";

std::string_view take_value(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(xml_space), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(xml_space));
  text.remove_prefix(word.size());
  return word;
}

std::string_view attribute_of(pugi::xml_node node, const char* name) {
  return node.attribute(name).value();
}

}  // namespace

Error VtuDocument::error_at(pugi::xml_node node, const std::string& what) const {
  const auto offset =
      std::clamp<std::ptrdiff_t>(node.offset_debug(), 0, static_cast<std::ptrdiff_t>(file_.bytes.size()));
  const auto line = 1 + std::count(file_.bytes.begin(), file_.bytes.begin() + offset, '\n');
  return {file_.name + ", line " + std::to_string(line) + ": " + what};
}

Result<void> VtuDocument::parse() {
  std::string xml = file_.bytes;
  if (auto found = find_appended(xml); !found) return found;
  const pugi::xml_parse_result parsed = xml_.load_buffer(xml.data(), xml.size());
  if (!parsed) {
    return Error{file_.name + ", byte " + std::to_string(parsed.offset) +
                 ": is not well-formed XML: " + parsed.description()};
  }
  const pugi::xml_node root = xml_.child("VTKFile");
  if (!root) return Error{file_.name + ": has no <VTKFile>"};
  const std::string_view type = attribute_of(root, "type");
  if (type != "UnstructuredGrid") {
    return error_at(root, "a VTK file of type " + quoted(type) + " is not supported; UnstructuredGrid is");
  }
  if (auto read = read_layout(root); !read) return read;
  grid_ = root.child("UnstructuredGrid");
  if (!grid_) return error_at(root, "has no <UnstructuredGrid>");
  return {};
}

// What is appended need not be XML: it is taken out before that is parsed.
Result<void> VtuDocument::find_appended(std::string& xml) {
  const std::size_t start = file_.bytes.find("<AppendedData");
  if (start == std::string::npos) return {};
  const std::size_t end = file_.bytes.find('>', start);
  const std::size_t mark = end == std::string::npos ? end : file_.bytes.find_first_not_of(xml_space, end + 1);
  if (mark == std::string::npos || file_.bytes[mark] != '_') {
    return Error{file_.name + ", byte " + std::to_string(start) + ": <AppendedData> does not begin with '_'"};
  }
  appended_ = std::string_view(file_.bytes).substr(mark + 1);
  xml.resize(end + 1);
  xml += "</AppendedData></VTKFile>";
  return {};
}

Result<void> VtuDocument::read_layout(pugi::xml_node root) {
  const std::string_view order = attribute_of(root, "byte_order");
  if (!order.empty() && order != "LittleEndian" && order != "BigEndian") {
    return error_at(root, "byte_order " + quoted(order) + " is neither LittleEndian nor BigEndian");
  }
  layout_.order = order == "BigEndian" ? ByteOrder::big : ByteOrder::little;
  const std::string_view header = attribute_of(root, "header_type");
  if (!header.empty() && header != "UInt32" && header != "UInt64") {
    return error_at(root, "header_type " + quoted(header) + " is neither UInt32 nor UInt64");
  }
  layout_.header_bytes = header == "UInt64" ? 8 : 4;
  const std::string_view compressor = attribute_of(root, "compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    return error_at(root, "the compressor " + quoted(compressor) + " is not supported; vtkZLibDataCompressor is");
  }
  layout_.compressed = !compressor.empty();
  const pugi::xml_node appended = root.child("AppendedData");
  const std::string_view encoding = attribute_of(appended, "encoding");
  if (appended && encoding != "raw" && encoding != "base64") {
    return error_at(appended, "the encoding " + quoted(encoding) + " is neither raw nor base64");
  }
  appended_encoding_ = encoding == "raw" ? VtuEncoding::raw : VtuEncoding::base64;
  return {};
}

Result<std::int64_t> VtuDocument::count_of(pugi::xml_node node, const char* attribute) const {
  const std::string_view text = attribute_of(node, attribute);
  const auto count = parse_integer(text);
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (count && *count >= 0 && *count <= most) return *count;
  return error_at(
      node, std::string(attribute) + " = " + quoted(text) + " is not a whole number from 0 to " + std::to_string(most));
}

Result<const VtkNumberType*> VtuDocument::type_of(pugi::xml_node array) const {
  const std::string_view name = attribute_of(array, "type");
  if (const VtkNumberType* type = find_xml_type(name)) return type;
  return error_at(array, "the type " + quoted(name) + " is not supported");
}

Result<std::string> VtuDocument::bytes_of(pugi::xml_node array, const VtkNumberType& type, std::int64_t count) const {
  const std::uint64_t expected = static_cast<std::uint64_t>(count) * type.bytes;
  const std::string_view format = attribute_of(array, "format");
  std::string_view source = array.child_value();
  VtuEncoding encoding = VtuEncoding::base64;
  if (format == "appended") {
    const auto offset = parse_integer(attribute_of(array, "offset"));
    if (!offset || *offset < 0 || static_cast<std::uint64_t>(*offset) > appended_.size()) {
      return error_at(array, "offset = " + quoted(attribute_of(array, "offset")) + " is none of the " +
                                 std::to_string(appended_.size()) + " bytes appended");
    }
    source = appended_.substr(static_cast<std::size_t>(*offset));
    encoding = appended_encoding_;
  } else if (format != "binary") {
    return error_at(array, "the format " + quoted(format) + " is none of ascii, binary and appended");
  }
  auto bytes = unpack_vtu_data(source, encoding, layout_, expected);
  if (!bytes) return error_at(array, "the array " + quoted(attribute_of(array, "Name")) + ": " + bytes.error().message);
  return bytes;
}

template <class T, class Parse>
Result<std::vector<T>> VtuDocument::parse_text(pugi::xml_node array, std::int64_t count, Parse parse_word) const {
  std::string_view text = array.child_value();
  std::vector<T> values;
  for (std::string_view word = take_value(text); !word.empty(); word = take_value(text)) {
    const std::optional<T> value = parse_word(word);
    if (!value) {
      return error_at(array, "found " + quoted(word) + " as value " + std::to_string(values.size()) + " of the array " +
                                 quoted(attribute_of(array, "Name")));
    }
    values.push_back(*value);
  }
  if (values.size() == static_cast<std::uint64_t>(count)) return values;
  return error_at(array, "the array " + quoted(attribute_of(array, "Name")) + " has " + std::to_string(values.size()) +
                             " values where " + std::to_string(count) + " are expected");
}

Result<std::vector<double>> VtuDocument::reals_of(pugi::xml_node array, std::int64_t count) const {
  const auto type = type_of(array);
  if (!type) return type.error();
  if (attribute_of(array, "format") == "ascii") return parse_text<double>(array, count, parse_number);
  const auto bytes = bytes_of(array, *type.value(), count);
  if (!bytes) return bytes.error();
  return read_reals(bytes.value(), *type.value(), layout_.order);
}

Result<std::vector<std::int64_t>> VtuDocument::integers_of(pugi::xml_node array, std::int64_t count) const {
  const auto type = type_of(array);
  if (!type) return type.error();
  if (type.value()->kind == NumberKind::real) return error_at(array, "holds no whole numbers");
  if (attribute_of(array, "format") == "ascii") return parse_text<std::int64_t>(array, count, parse_integer);
  const auto bytes = bytes_of(array, *type.value(), count);
  if (!bytes) return bytes.error();
  auto values = read_integers(bytes.value(), *type.value(), layout_.order);
  if (!values) return error_at(array, "a number is larger than 2^63 - 1");
  return std::move(*values);
}

}  // namespace flexcast
