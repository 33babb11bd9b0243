#include "idl/wire/host_network.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace flexcast::wire {

std::vector<NetworkInterface> find_interfaces() {
  std::vector<NetworkInterface> found;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return found;
  for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET || (one->ifa_flags & IFF_UP) == 0) continue;
    std::array<char, INET_ADDRSTRLEN> address{};
    const auto* socket_address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    inet_ntop(AF_INET, &socket_address->sin_addr, address.data(), address.size());
    found.push_back(
        {one->ifa_name, address.data(), (one->ifa_flags & IFF_LOOPBACK) != 0, (one->ifa_flags & IFF_MULTICAST) != 0});
  }
  freeifaddrs(list);
  return found;
}

std::size_t grant_receive_buffer(std::size_t asked) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return 0;
  const int wanted = static_cast<int>(asked);
  int granted = 0;
  socklen_t size = sizeof granted;
  (void)setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &wanted, sizeof wanted);
  (void)getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &granted, &size);
  close(socket);
  return static_cast<std::size_t>(granted) / 2;  // Linux doubles what it grants, for its own book-keeping
}

}  // namespace flexcast::wire
