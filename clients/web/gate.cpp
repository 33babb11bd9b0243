#include "clients/web/gate.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace flexcast::web {
namespace {

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_address(int family, std::string_view text) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(family, std::string(text).c_str(), address.data()) == 1;
}

// "[::1]:8080" -> "::1"; no brackets, no name.
bool is_bracketed_address(std::string_view host) {
  const std::size_t end = host.find(']');
  if (!host.starts_with('[') || end == std::string_view::npos) return false;
  const std::string_view rest = host.substr(end + 1);
  return is_address(AF_INET6, host.substr(1, end - 1)) &&
         (rest.empty() || (rest.front() == ':' && is_port(rest.substr(1))));
}

}  // namespace

bool Gate::admits_host(std::string_view host) const {
  if (is_bracketed_address(host)) return true;
  const std::size_t colon = host.find(':');
  const std::string_view name = host.substr(0, colon);
  if (colon != std::string_view::npos && !is_port(host.substr(colon + 1))) return false;
  if (name.empty()) return false;
  return is_address(AF_INET, name) || same_letters(name, "localhost") || same_letters(name, bind_);
}

bool Gate::admits_origin(std::string_view origin, std::string_view host) const {
  if (origin.empty()) return true;
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme) && same_letters(origin.substr(scheme.size()), host)) return true;
  return std::any_of(origins_.begin(), origins_.end(),
                     [&](const std::string& allowed) { return allowed == "*" || same_letters(allowed, origin); });
}

}  // namespace flexcast::web
