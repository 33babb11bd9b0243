#include "core/mesh/vtu_data.h"

#include <zlib.h>

#include <array>
#include <vector>

namespace flexcast {
namespace {

constexpr int not_base64 = -1;

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : not_base64;
}

bool is_white_space(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

// The first bytes of base64 text, fewer if it ends or something else follows. What comes before data may have been
// encoded by itself, so groups may end in padding amid the text.
std::string decode_base64(std::string_view text, std::uint64_t most) {
  std::string bytes;
  std::array<int, 4> group{};
  std::size_t filled = 0, padding = 0;
  for (std::size_t i = 0; i < text.size() && bytes.size() < most; ++i) {
    if (is_white_space(text[i])) continue;
    const bool pads = text[i] == '=' && filled >= 2;
    const int value = pads ? 0 : value_of(text[i]);
    if (value == not_base64 || (padding > 0 && !pads)) break;
    padding += pads ? 1 : 0;
    group[filled++] = value;
    if (filled < 4) continue;
    const int bits = group[0] << 18 | group[1] << 12 | group[2] << 6 | group[3];
    for (std::size_t byte = 0; byte < 3 - padding; ++byte) bytes += static_cast<char>(bits >> (16 - 8 * byte) & 0xff);
    filled = padding = 0;
  }
  if (bytes.size() > most) bytes.resize(most);
  return bytes;
}

class Unpacker {
 public:
  Unpacker(std::string_view source, VtuEncoding encoding, const VtuLayout& layout)
      : source_(source), encoding_(encoding), layout_(layout) {}

  Result<std::string> unpack(std::uint64_t expected) {
    return layout_.compressed ? unpack_blocks(expected) : unpack_plain(expected);
  }

 private:
  // Bytes of the source, counted behind the encoding; nothing if there are not so many.
  Result<std::string> take(std::uint64_t first, std::uint64_t count) {
    constexpr const char* short_text = "the data end early, or are not encoded as the file says";
    if (count > source_.size() || first > source_.size() - count) return Error{short_text};
    std::string bytes = encoding_ == VtuEncoding::raw ? std::string(source_.substr(0, first + count))
                                                      : decode_base64(source_, first + count);
    if (bytes.size() < first + count) return Error{short_text};
    return bytes.substr(first);
  }

  Result<std::vector<std::uint64_t>> take_numbers(std::uint64_t first, std::uint64_t count) {
    const auto bytes = take(first * layout_.header_bytes, count * layout_.header_bytes);
    if (!bytes) return bytes.error();
    const VtkNumberType& type = *find_xml_type(layout_.header_bytes == 4 ? "UInt32" : "UInt64");
    const auto numbers = read_integers(bytes.value(), type, layout_.order);
    if (!numbers) return Error{"a number before the data is larger than 2^63 - 1"};
    return std::vector<std::uint64_t>(numbers->begin(), numbers->end());
  }

  static Error wrong_size(std::uint64_t found, std::uint64_t expected) {
    return {"has " + std::to_string(found) + " bytes where " + std::to_string(expected) + " are expected"};
  }

  Result<std::string> unpack_plain(std::uint64_t expected) {
    const auto size = take_numbers(0, 1);
    if (!size) return size.error();
    if (size.value()[0] != expected) return wrong_size(size.value()[0], expected);
    return take(layout_.header_bytes, expected);
  }

  // Number of blocks, size of a block, size of the last one if that is less, then of each block its compressed size.
  Result<std::string> unpack_blocks(std::uint64_t expected) {
    const auto head = take_numbers(0, 3);
    if (!head) return head.error();
    const std::uint64_t blocks = head.value()[0], size = head.value()[1], last = head.value()[2];
    if (blocks > source_.size() || (blocks > 0 && size > expected && blocks > (last > 0 ? 1U : 0U))) {
      return Error{"has " + std::to_string(blocks) + " blocks of " + std::to_string(size) + " bytes where " +
                   std::to_string(expected) + " bytes are expected in all"};
    }
    const std::uint64_t whole = blocks - (blocks > 0 && last > 0 ? 1 : 0);
    if (whole > 0 && size > expected / whole) return wrong_size(whole * size, expected);
    const std::uint64_t total = whole * size + (blocks > whole ? last : 0);
    if (total != expected) return wrong_size(total, expected);
    const auto packed = take_numbers(3, blocks);
    if (!packed) return packed.error();
    return inflate_blocks(packed.value(), whole, size, expected);
  }

  Result<std::string> inflate_blocks(const std::vector<std::uint64_t>& packed, std::uint64_t whole, std::uint64_t size,
                                     std::uint64_t expected) {
    std::uint64_t packed_bytes = 0;
    for (const std::uint64_t bytes : packed) {
      if (bytes > source_.size() - packed_bytes) return Error{"the compressed blocks are longer than the file"};
      packed_bytes += bytes;
    }
    const auto content = take((3 + packed.size()) * layout_.header_bytes, packed_bytes);
    if (!content) return content.error();
    constexpr std::uint64_t largest_ratio = 1040;  // zlib reaches 1032
    if (expected / largest_ratio > packed_bytes) {
      return Error{std::to_string(packed_bytes) + " compressed bytes cannot become " + std::to_string(expected)};
    }
    std::string bytes(expected, '\0');
    std::uint64_t from = 0, to = 0;
    for (std::size_t i = 0; i < packed.size(); ++i) {
      const std::uint64_t block = i < whole ? size : expected - to;
      uLongf written = block;
      const auto* source = reinterpret_cast<const Bytef*>(content.value().data() + from);
      const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data() + to), &written, source, packed[i]);
      if (code != Z_OK || written != block) return Error{"block " + std::to_string(i) + " of zlib's is damaged"};
      from += packed[i];
      to += block;
    }
    return bytes;
  }

  std::string_view source_;
  VtuEncoding encoding_;
  VtuLayout layout_;
};

}  // namespace

Result<std::string> unpack_vtu_data(std::string_view source, VtuEncoding encoding, const VtuLayout& layout,
                                    std::uint64_t expected) {
  return Unpacker(source, encoding, layout).unpack(expected);
}

}  // namespace flexcast
