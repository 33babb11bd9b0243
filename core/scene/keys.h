// The keys of a scene file's large tables, for its readers, their error texts and the documentation.
#pragma once

#include <string_view>
#include <vector>

namespace flexcast {

std::vector<std::string_view> scene_keys();    // at the top
std::vector<std::string_view> body_keys();     // of a [[body]], of both models
std::vector<std::string_view> contact_keys();  // of a [[contact]], of all shapes

// What `exact` may name: solutions that are known without integrating (core/lab/trade_exact.h has them).
std::vector<std::string_view> exact_names();

}  // namespace flexcast
