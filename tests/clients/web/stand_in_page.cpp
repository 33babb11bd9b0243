// In place of the page: two small files, one of them compressed.
#include <array>

#include "clients/web/assets.h"

namespace flexcast::web {
namespace {

constexpr std::string_view index_text = "<!doctype html><title>flexcast</title><p>This build has no page.\n";
// "ok\n" by gzip.
constexpr std::array<unsigned char, 23> script{0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x03, 0xcb, 0xcf,
                                               0xe6, 0x02, 0x00, 0x7d, 0x0e, 0x16, 0xda, 0x03, 0x00, 0x00, 0x00};

const std::array<Asset, 2> table{
    Asset{"/",
          "text/html; charset=utf-8",
          {reinterpret_cast<const unsigned char*>(index_text.data()), index_text.size()},
          false},
    Asset{"/assets/ok.txt", "text/plain; charset=utf-8", script, true},
};

}  // namespace

std::span<const Asset> assets() {
  return table;
}

}  // namespace flexcast::web
