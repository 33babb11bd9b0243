#include "clients/web/site.h"

#include <array>
#include <cstdint>

namespace flexcast::web {
namespace {

constexpr std::array<std::string_view, 2> subprotocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr const char* content_security_policy =
    "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
    "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

HttpReply say(unsigned status, const std::string& text) {
  return {.status = status,
          .headers = {{"Content-Type", "text/plain; charset=utf-8"}, {"Cache-Control", "no-store"}},
          .text = text + "\n"};
}

std::string_view trim(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

// Calls for each element of "a, b, c" until one call returns true.
template <class Visit>
bool any_of_list(std::string_view list, const Visit& visit) {
  for (;;) {
    const std::size_t comma = list.find(',');
    if (visit(trim(list.substr(0, comma)))) return true;
    if (comma == std::string_view::npos) return false;
    list.remove_prefix(comma + 1);
  }
}

// FNV-1a: names the content, guards nothing.
std::string make_entity_tag(std::span<const unsigned char> content) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char byte : content) hash = (hash ^ byte) * 1099511628211ULL;
  return "\"" + std::to_string(hash) + "\"";
}

}  // namespace

Site::Site(Gate gate, std::span<const Asset> assets, std::function<bool()> is_full)
    : gate_(std::move(gate)), is_full_(std::move(is_full)) {
  for (const Asset& asset : assets) {
    assets_[asset.path] = &asset;
    entity_tags_[asset.path] = make_entity_tag(asset.content);
  }
}

HttpReply Site::answer(const HttpRequest& request) const {
  if (!gate_.admits_host(request.host))
    return say(403, "not under this name: the host must be an address, localhost or what --bind names");
  if (request.is_upgrade) return upgrade(request);
  if (request.method != "GET" && request.method != "HEAD") {
    HttpReply reply = say(405, "only GET and HEAD");
    reply.headers.emplace_back("Allow", "GET, HEAD");
    return reply;
  }
  const auto asset = assets_.find(std::string_view(request.target).substr(0, request.target.find('?')));
  if (asset == assets_.end()) return say(404, "there is no such file");
  return serve(request, *asset->second);
}

HttpReply Site::upgrade(const HttpRequest& request) const {
  if (!gate_.admits_origin(request.origin, request.host))
    return say(403, "pages of " + request.origin.substr(0, 200) +
                        " may not connect: start flexcast-web with --allow-origin to let them");
  if (request.target.substr(0, request.target.find('?')) != "/") return say(404, "the WebSocket is at /");
  const std::string subprotocol = choose_subprotocol(request.subprotocols);
  if (subprotocol.empty()) return say(400, "the subprotocol must be foxglove.sdk.v1 or foxglove.websocket.v1");
  if (is_full_()) return say(503, "there are too many clients");
  return {.status = 101, .subprotocol = subprotocol};
}

HttpReply Site::serve(const HttpRequest& request, const Asset& asset) const {
  const std::string& tag = entity_tags_.at(asset.path);
  HttpReply reply{.headers = {{"Content-Type", std::string(asset.content_type)},
                              {"Cache-Control", "no-cache"},
                              {"ETag", tag},
                              {"Vary", "Accept-Encoding"},
                              {"Content-Security-Policy", content_security_policy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"}}};
  if (asset.gzip && !accepts_gzip(request.accept_encoding))
    return say(406, "this file comes compressed only (Accept-Encoding: gzip; with curl: --compressed)");
  const bool known = any_of_list(request.if_none_match, [&](std::string_view known_tag) { return known_tag == tag; });
  if (known) {
    reply.status = 304;
    return reply;
  }
  if (asset.gzip) reply.headers.emplace_back("Content-Encoding", "gzip");
  reply.content = asset.content;
  return reply;
}

std::string choose_subprotocol(std::string_view offered) {
  std::string chosen;
  any_of_list(offered, [&](std::string_view name) {
    for (const std::string_view ours : subprotocols)
      if (name == ours) chosen = ours;
    return !chosen.empty();
  });
  return chosen;
}

bool accepts_gzip(std::string_view accept_encoding) {
  return any_of_list(accept_encoding, [](std::string_view entry) {
    const std::size_t semicolon = entry.find(';');
    const std::string_view coding = trim(entry.substr(0, semicolon));
    if (coding != "gzip" && coding != "*") return false;
    if (semicolon == std::string_view::npos) return true;
    const std::string_view weight = trim(entry.substr(semicolon + 1));
    return weight.find_first_not_of("q=0. ") != std::string_view::npos;
  });
}

}  // namespace flexcast::web
