// VtuDocument: the XML of a `.vtu` file, its arrays as numbers.
#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/file_cursor.h"
#include "core/mesh/vtu_data.h"

namespace flexcast {

class VtuDocument {
 public:
  // The content must outlive this object.
  explicit VtuDocument(const FileContent& file) : file_(file) {}
  VtuDocument(const VtuDocument&) = delete;
  VtuDocument& operator=(const VtuDocument&) = delete;

  Result<void> parse();
  pugi::xml_node grid() const { return grid_; }  // <UnstructuredGrid>, after parse()

  // A count among the attributes of a node, not negative.
  Result<std::int64_t> count_of(pugi::xml_node node, const char* attribute) const;

  // The numbers of a <DataArray>, as many as said.
  Result<std::vector<double>> reals_of(pugi::xml_node array, std::int64_t count) const;
  Result<std::vector<std::int64_t>> integers_of(pugi::xml_node array, std::int64_t count) const;

  // "<name>, line <n>: <what>", of the node.
  Error error_at(pugi::xml_node node, const std::string& what) const;

 private:
  Result<void> find_appended(std::string& xml);
  Result<void> read_layout(pugi::xml_node root);
  Result<const VtkNumberType*> type_of(pugi::xml_node array) const;
  Result<std::string> bytes_of(pugi::xml_node array, const VtkNumberType& type, std::int64_t count) const;
  template <class T, class Parse>
  Result<std::vector<T>> parse_text(pugi::xml_node array, std::int64_t count, Parse parse_word) const;

  const FileContent& file_;
  pugi::xml_document xml_;
  pugi::xml_node grid_;
  VtuLayout layout_;
  std::string_view appended_;  // behind the underscore
  VtuEncoding appended_encoding_ = VtuEncoding::base64;
};

}  // namespace flexcast
