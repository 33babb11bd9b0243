// Net: one port for HTTP and WebSockets, on one thread. The only door to Boost: net.cpp is its one translation unit,
// since it takes half a minute and a gigabyte to compile.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "clients/web/http.h"
#include "clients/web/line.h"
#include "idl/wire/result.h"

namespace flexcast::web {

struct NetOptions {
  std::string bind = "127.0.0.1";  // an address, or a name that stands for one
  std::uint16_t port = 8080;       // 0: a free one
};

namespace limits {
inline constexpr std::size_t header_bytes = 8 * 1024;
inline constexpr std::size_t message_bytes = 64 * 1024;  // from a client
inline constexpr std::size_t requests = 64;              // connections that are no WebSockets; then the oldest goes
inline constexpr std::chrono::seconds request_time{10};  // to send a request, to take its reply
inline constexpr std::chrono::seconds silence{30};       // of a client; it is pinged at half of that
inline constexpr std::chrono::seconds farewell{2};       // to answer a close
inline constexpr int send_buffer = 512 * 1024;           // of a socket: what a slow client lags behind at most
}  // namespace limits

// Called on the thread of run().
struct NetHandlers {
  std::function<HttpReply(const HttpRequest&)> respond;
  std::function<std::unique_ptr<Peer>(Line&)> connect;  // the line outlives its peer
  std::function<void()> woken;                          // after wake()
  std::function<void()> tick;                           // ten times a second
};

class Net {
 public:
  // The error says what keeps it from listening there.
  static wire::Result<std::unique_ptr<Net>> listen(const NetOptions& options, NetHandlers handlers);
  ~Net();
  Net(const Net&) = delete;
  Net& operator=(const Net&) = delete;

  std::uint16_t port() const;

  // Serves until SIGINT, SIGTERM or stop(), then says goodbye to the clients.
  void run();

  // From any thread. Calls before the handler has run count as one.
  void wake();
  void stop();

 private:
  class Implementation;
  explicit Net(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace flexcast::web
