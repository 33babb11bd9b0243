// The files of the page, embedded in the program: one fixed table, nothing is read from the disk.
#pragma once

#include <span>
#include <string_view>

namespace flexcast::web {

struct Asset {
  std::string_view path;          // "/" or "/assets/NAME"
  std::string_view content_type;  // "text/html; charset=utf-8"
  std::span<const unsigned char> content;
  bool gzip;  // the content is compressed
};

// Made by the build from clients/web/page.
std::span<const Asset> assets();

}  // namespace flexcast::web
