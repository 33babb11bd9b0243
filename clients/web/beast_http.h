// BeastHttp: one connection that speaks HTTP, until it ends or becomes a WebSocket. Internal to net.cpp.
#pragma once

#include <memory>
#include <optional>

#include "clients/web/beast.h"
#include "clients/web/beast_line.h"

namespace flexcast::web {

// shared: by the operations under way, as asio wants it.
class BeastHttp : public std::enable_shared_from_this<BeastHttp> {
 public:
  using KeepLine = std::function<void(const std::shared_ptr<BeastLine>&)>;

  // `handlers` outlives it; `keep` is told of the line it becomes.
  BeastHttp(Tcp::socket socket, const NetHandlers& handlers, KeepLine keep)
      : stream_(std::move(socket)), handlers_(handlers), keep_(std::move(keep)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(limits::header_bytes);
    stream_.expires_after(limits::request_time);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](ErrorCode error, std::size_t) { self->receive(error); });
  }

  void end() {
    ErrorCode ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_both, ignored);
    stream_.close();
  }

 private:
  using Request = http::request<http::empty_body>;

  void receive(ErrorCode error) {
    if (error == http::error::header_limit) return refuse(431, "the header has more than 8 KiB\n");
    if (error && error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message)
      return refuse(400, "this is no request that is understood here\n");
    if (error) return end();
    const Request request = parser_->release();
    reply_ = handlers_.respond(describe(request));
    if (reply_.status == 101) return upgrade(request);
    write(request.keep_alive(), request.method() == http::verb::head);
  }

  static HttpRequest describe(const Request& request) {
    const auto field = [&](http::field name) { return to_string(request[name]); };
    return {.method = to_string(request.method_string()),
            .target = to_string(request.target()),
            .host = request.count(http::field::host) == 1 ? field(http::field::host) : "",
            .origin = field(http::field::origin),
            .accept_encoding = field(http::field::accept_encoding),
            .if_none_match = field(http::field::if_none_match),
            .subprotocols = field(http::field::sec_websocket_protocol),
            .is_upgrade = websocket::is_upgrade(request)};
  }

  void upgrade(const Request& request) {
    const auto line = std::make_shared<BeastLine>(std::move(stream_));
    keep_(line);
    line->accept(request, reply_.subprotocol, handlers_.connect);
  }

  void refuse(unsigned status, const char* text) {
    reply_ = {.status = status, .headers = {{"Content-Type", "text/plain; charset=utf-8"}}, .text = text};
    write(false, false);
  }

  void write(bool keep_alive, bool head_only) {
    std::span<const unsigned char> body = reply_.content;
    if (body.empty()) body = {reinterpret_cast<const unsigned char*>(reply_.text.data()), reply_.text.size()};
    response_.emplace();
    response_->version(11);
    response_->result(reply_.status);
    response_->set(http::field::server, "flexcast-web");
    for (const auto& [name, value] : reply_.headers)
      response_->set(beast::string_view(name.data(), name.size()), value);
    response_->keep_alive(keep_alive);
    if (reply_.status != 304) response_->content_length(body.size());
    if (!head_only && reply_.status != 304) response_->body() = {body.data(), body.size()};
    stream_.expires_after(limits::request_time);
    http::async_write(stream_, *response_, [self = shared_from_this(), keep_alive](ErrorCode error, std::size_t) {
      if (error || !keep_alive) return self->end();
      self->read();
    });
  }

  beast::tcp_stream stream_;
  const NetHandlers& handlers_;
  KeepLine keep_;
  beast::flat_buffer buffer_{2 * limits::header_bytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
  HttpReply reply_;
  std::optional<http::response<http::span_body<const unsigned char>>> response_;
};

}  // namespace flexcast::web
