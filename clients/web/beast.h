// What of Boost is used. Internal to net.cpp.
#pragma once

#include <utility>  // asio's own headers forget it under C++20

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace flexcast::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using Tcp = asio::ip::tcp;
using ErrorCode = beast::error_code;

inline std::string to_string(beast::string_view text) {
  return {text.data(), text.size()};
}

}  // namespace flexcast::web
