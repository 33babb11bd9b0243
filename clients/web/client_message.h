// What clients say, parsed. Trusts nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clients/client/json.h"

namespace flexcast::web {

using client::Json;

struct Subscribe {
  struct Entry {
    std::uint32_t id, channel;
  };
  std::vector<Entry> entries;
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};
struct GetParameters {
  std::vector<std::string> names;  // none: all
  std::optional<std::string> id;
};
struct SetParameters {
  struct Entry {
    std::string name;
    Json value;  // null: to be unset
  };
  std::vector<Entry> entries;
  std::optional<std::string> id;
};
struct WatchParameters {
  bool on = true;
  std::vector<std::string> names;  // none: all
};
struct CallService {
  std::uint32_t service = 0, call = 0;
  std::string encoding;
  std::string payload;
};

using ClientMessage = std::variant<Subscribe, Unsubscribe, GetParameters, SetParameters, WatchParameters, CallService>;

// The error says what is wrong, for the client.
wire::Result<ClientMessage> parse_message(bool is_text, std::string_view message);

// JSON that is nested at most so deep.
inline constexpr int deepest_json = 16;
wire::Result<Json> parse_json(std::string_view text);

}  // namespace flexcast::web
