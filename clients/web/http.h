// HTTP requests and replies, without a network.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexcast::web {

struct HttpRequest {
  std::string method{};  // "GET"
  std::string target{};  // "/assets/page.js?x=1"
  std::string host{};    // as sent, "" without
  std::string origin{};
  std::string accept_encoding{};
  std::string if_none_match{};
  std::string subprotocols{};  // Sec-WebSocket-Protocol: "a, b"
  bool is_upgrade = false;     // to a WebSocket
};

struct HttpReply {
  unsigned status = 200;  // 101: go on as a WebSocket, which speaks `subprotocol`
  std::vector<std::pair<std::string_view, std::string>> headers{};
  std::string text{};                        // the body,
  std::span<const unsigned char> content{};  // or this, which is never freed
  std::string subprotocol{};
};

}  // namespace flexcast::web
