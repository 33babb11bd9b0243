// Offenders: names the first few nodes or elements at fault and counts all of them.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace flexcast {

class Offenders {
 public:
  void add(std::string name) {
    if (++count_ <= most_named) names_.push_back(std::move(name));
  }
  bool any() const { return count_ > 0; }

  // "node 3", "nodes 3, 7, 9, 12, 15, ... (28 in all)"
  std::string text(const std::string& noun) const {
    std::string list = noun + (count_ == 1 ? " " : "s ");
    for (std::size_t i = 0; i < names_.size(); ++i) list += (i == 0 ? "" : ", ") + names_[i];
    if (count_ > most_named) list += ", ... (" + std::to_string(count_) + " in all)";
    return list;
  }

 private:
  static constexpr std::size_t most_named = 5;
  std::size_t count_ = 0;
  std::vector<std::string> names_;
};

}  // namespace flexcast
