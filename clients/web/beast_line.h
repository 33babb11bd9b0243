// BeastLine: one WebSocket. Internal to net.cpp.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "clients/web/beast.h"
#include "clients/web/net.h"

namespace flexcast::web {

// shared: by the operations under way, as asio wants it; the last one that ends destroys it.
class BeastLine final : public Line, public std::enable_shared_from_this<BeastLine> {
 public:
  explicit BeastLine(beast::tcp_stream stream) : socket_(std::move(stream)), farewell_(socket_.get_executor()) {}

  template <class Request>
  void accept(const Request& request, const std::string& subprotocol,
              std::function<std::unique_ptr<Peer>(Line&)> connect) {
    set_up(subprotocol);
    socket_.async_accept(request, [self = shared_from_this(), connect = std::move(connect)](ErrorCode error) {
      if (!error) self->start(connect);
    });
  }

  void wake() override { send(); }

  void close(CloseCode code, const std::string& reason) override {
    if (closing_) return;
    closing_ = true;
    farewell_.expires_after(limits::farewell);
    farewell_.async_wait([self = shared_from_this()](ErrorCode error) {
      if (!error) self->end();
    });
    const websocket::close_reason why(static_cast<websocket::close_code>(code), reason.substr(0, 120));
    socket_.async_close(why, [self = shared_from_this()](ErrorCode) { self->end(); });
  }

 private:
  void set_up(const std::string& subprotocol) {
    beast::get_lowest_layer(socket_).expires_never();  // the socket has timeouts of its own
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = limits::request_time;
    timeout.idle_timeout = limits::silence;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, subprotocol);
      response.set(http::field::server, "flexcast-web");
    }));
    socket_.read_message_max(limits::message_bytes);
    socket_.auto_fragment(false);  // a message is one frame: it goes out from where it lies
    ErrorCode ignored;
    Tcp::socket& socket = beast::get_lowest_layer(socket_).socket();
    socket.set_option(Tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(limits::send_buffer), ignored);
  }

  void start(const std::function<std::unique_ptr<Peer>(Line&)>& connect) {
    // Not by shared_from_this: the socket must not own what owns it.
    socket_.control_callback([this](websocket::frame_type, beast::string_view) {
      if (peer_) peer_->receive_control();
    });
    peer_ = connect(*this);
    if (!peer_) return close(CloseCode::try_again, "too many clients");
    send();
    read();
  }

  void read() {
    if (closing_ || !peer_) return;
    socket_.async_read(incoming_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      if (error) return self->end();
      self->receive();
    });
  }

  void receive() {
    if (!peer_) return;
    const auto data = incoming_.cdata();
    peer_->receive(socket_.got_text(), {static_cast<const char*>(data.data()), data.size()});
    incoming_.consume(incoming_.size());
    read();
  }

  void send() {
    if (sending_ || closing_ || !peer_) return;
    sending_ = peer_->next();
    if (!sending_) return;
    const std::span<const std::byte> body = sending_->body;
    socket_.text(sending_->is_text);
    socket_.async_write(std::array{asio::const_buffer(sending_->head.data(), sending_->head.size()),
                                   asio::const_buffer(body.data(), body.size())},
                        [self = shared_from_this()](ErrorCode error, std::size_t) {
                          self->sending_.reset();
                          if (error) return self->end();
                          self->send();
                        });
  }

  void end() {
    closing_ = true;
    farewell_.cancel();
    peer_.reset();
    ErrorCode ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

  websocket::stream<beast::tcp_stream, false> socket_;  // false: nothing is compressed
  asio::steady_timer farewell_;
  beast::flat_buffer incoming_{limits::message_bytes};
  std::optional<Outgoing> sending_;
  bool closing_ = false;
  std::unique_ptr<Peer> peer_;
};

}  // namespace flexcast::web
