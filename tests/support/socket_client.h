// SocketClient: a bare TCP client of flexcast-web on 127.0.0.1, which speaks WebSocket or whatever a test wants to say.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace flexcast::test {

struct SocketMessage {
  int opcode = 0;  // 1: text, 2: binary, 8: close, 9: ping
  std::string content;
};

class SocketClient {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds patience{20};

  // `receive_buffer`: bytes, 0: the system's choice.
  explicit SocketClient(std::uint16_t port, int receive_buffer = 0) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (receive_buffer > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    const int on = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~SocketClient() {
    if (socket_ >= 0) close(socket_);
  }
  SocketClient(SocketClient&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), connected_(other.connected_), buffer_(std::move(other.buffer_)) {}
  SocketClient& operator=(SocketClient&&) = delete;

  bool connected() const { return connected_; }

  // False when the other side has gone, or does not take it in time.
  bool say(std::string_view bytes) {
    const auto latest = Clock::now() + patience;
    while (!bytes.empty()) {
      const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) {
        bytes.remove_prefix(static_cast<std::size_t>(count));
      } else if (count < 0 && errno == EAGAIN && Clock::now() < latest) {
        pollfd entry{socket_, POLLOUT, 0};
        poll(&entry, 1, 100);
      } else {
        return false;
      }
    }
    return true;
  }

  // The head of a reply and, if it says how long that is, its body; "" when there is none.
  std::string ask(const std::string& request) {
    if (!say(request)) return "";
    const auto latest = Clock::now() + patience;
    for (;;) {
      const std::size_t end = buffer_.find("\r\n\r\n");
      if (end != std::string::npos) {
        const std::size_t size = end + 4 + body_size(buffer_.substr(0, end));
        if (buffer_.size() >= size) {
          std::string reply = buffer_.substr(0, size);
          buffer_.erase(0, size);
          return reply;
        }
      }
      if (!fill(latest)) return std::exchange(buffer_, "");
    }
  }

  // "HTTP/1.1 101 ..." when it may go on as a WebSocket.
  std::string upgrade(const std::string& more = "", const std::string& host = "localhost",
                      const std::string& protocol = "foxglove.websocket.v1") {
    return ask("GET / HTTP/1.1\r\nHost: " + host +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: " +
               protocol + "\r\n" + more + "\r\n");
  }

  bool send_text(const std::string& text) { return say(frame(1, text)); }
  bool send_json(const nlohmann::json& json) { return send_text(json.dump()); }
  bool send_binary(const std::string& bytes) { return say(frame(2, bytes)); }

  // A frame as clients send it: masked (with zeros).
  static std::string frame(int opcode, std::string_view content, bool last = true) {
    std::string bytes(1, static_cast<char>((last ? 0x80 : 0) | opcode));
    if (content.size() < 126) {
      bytes += static_cast<char>(0x80 | content.size());
    } else if (content.size() < 65536) {
      bytes += static_cast<char>(0x80 | 126);
      for (const int shift : {8, 0}) bytes += static_cast<char>(content.size() >> shift & 0xff);
    } else {
      bytes += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8)
        bytes += static_cast<char>(static_cast<std::uint64_t>(content.size()) >> shift & 0xff);
    }
    bytes.append(4, '\0');
    return bytes.append(content);
  }

  // The next message; none within the time, or when the connection has ended. Pings are answered.
  std::optional<SocketMessage> receive(std::chrono::nanoseconds timeout = patience) {
    const auto latest = Clock::now() + timeout;
    for (;;) {
      if (auto message = take_message()) {
        if (message->opcode != 9) return message;
        say(frame(10, message->content));
        continue;
      }
      if (!fill(latest)) return {};
    }
  }

  // The next text with this "op"; throws nothing: null when there is none.
  nlohmann::json receive_op(const std::string& op) {
    const auto latest = Clock::now() + patience;
    while (Clock::now() < latest) {
      const auto message = receive(latest - Clock::now());
      if (!message || message->opcode == 8) break;
      if (message->opcode != 1) continue;
      auto json = nlohmann::json::parse(message->content, nullptr, false);
      if (json.is_object() && json.value("op", "") == op) return json;
    }
    return {};
  }

  // Reads until the connection ends; the code of the close, 0 without one, none if it does not end.
  std::optional<int> wait_for_close(std::chrono::nanoseconds timeout = patience) {
    const auto latest = Clock::now() + timeout;
    while (Clock::now() < latest) {
      const auto message = receive(latest - Clock::now());
      if (message && message->opcode == 8)
        return message->content.size() < 2 ? 0
                                           : static_cast<unsigned char>(message->content[0]) << 8 |
                                                 static_cast<unsigned char>(message->content[1]);
      if (!message && ended_) return 0;
    }
    return {};
  }

  bool ended() const { return ended_; }

 private:
  static std::size_t body_size(const std::string& head) {
    const std::size_t at = head.find("Content-Length: ");
    return at == std::string::npos ? 0 : std::strtoul(head.c_str() + at + 16, nullptr, 10);
  }

  bool fill(Clock::time_point latest) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(latest - Clock::now()).count();
    pollfd entry{socket_, POLLIN, 0};
    if (left < 0 || poll(&entry, 1, static_cast<int>(left) + 1) <= 0) return false;
    const std::size_t before = buffer_.size();
    buffer_.resize(before + 256 * 1024);
    const ssize_t count = recv(socket_, buffer_.data() + before, buffer_.size() - before, MSG_DONTWAIT);
    buffer_.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count == 0 || (count < 0 && errno != EAGAIN)) ended_ = true;
    return !ended_;
  }

  std::optional<SocketMessage> take_message() {
    if (buffer_.size() < 2) return {};
    const auto byte = [&](std::size_t i) { return static_cast<std::uint64_t>(static_cast<unsigned char>(buffer_[i])); };
    std::uint64_t size = byte(1) & 127;
    const std::size_t head = size < 126 ? 2 : size == 126 ? 4 : 10;
    if (buffer_.size() < head) return {};
    if (head > 2) {
      size = 0;
      for (std::size_t i = 2; i < head; ++i) size = size << 8 | byte(i);
    }
    if (buffer_.size() < head + size) return {};
    SocketMessage message{static_cast<int>(byte(0) & 15), buffer_.substr(head, size)};
    buffer_.erase(0, head + size);
    return message;
  }

  int socket_ = -1;
  bool connected_ = false;
  bool ended_ = false;
  std::string buffer_;
};

}  // namespace flexcast::test
