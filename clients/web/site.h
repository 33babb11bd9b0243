// Site: answers HTTP requests from the table of assets, and says which may go on as WebSockets. No sockets here.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>

#include "clients/web/assets.h"
#include "clients/web/gate.h"
#include "clients/web/http.h"

namespace flexcast::web {

class Site {
 public:
  // `assets` outlive the site; `is_full`: whether there are too many clients.
  Site(Gate gate, std::span<const Asset> assets, std::function<bool()> is_full);

  HttpReply answer(const HttpRequest& request) const;

 private:
  HttpReply upgrade(const HttpRequest& request) const;
  HttpReply serve(const HttpRequest& request, const Asset& asset) const;

  Gate gate_;
  std::map<std::string_view, const Asset*> assets_;  // by path
  std::map<std::string_view, std::string> entity_tags_;
  std::function<bool()> is_full_;
};

// The first of the names that a client offers ("a, b") that is spoken here; "": none.
std::string choose_subprotocol(std::string_view offered);

// Whether an Accept-Encoding allows gzip.
bool accepts_gzip(std::string_view accept_encoding);

}  // namespace flexcast::web
