// Gate: whose requests are answered. Web pages of others must not reach a server on somebody's own machine, neither by
// a WebSocket (Origin) nor by a name of theirs that leads here (Host).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexcast::web {

class Gate {
 public:
  // `bind`: the name or address the program listens on. `origins`: of pages that may connect; "*": all.
  Gate(std::string bind, std::vector<std::string> origins) : bind_(std::move(bind)), origins_(std::move(origins)) {}

  // An IP address, localhost or the name that was bound, with or without a port.
  bool admits_host(std::string_view host) const;

  // None (programs that are no browsers), the page of this very host, or an allowed one.
  bool admits_origin(std::string_view origin, std::string_view host) const;

 private:
  std::string bind_;
  std::vector<std::string> origins_;
};

}  // namespace flexcast::web
