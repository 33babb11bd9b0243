#include "clients/mcap/crc32.h"

#include <zlib.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace flexcast::mcap {
namespace {

std::uint32_t crc32_by_zlib(Bytes bytes, std::uint32_t start) {
  return static_cast<std::uint32_t>(::crc32_z(start, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

#if defined(__x86_64__)

constexpr std::size_t kBlock = 16;
constexpr std::size_t kLanes = 4;
constexpr std::size_t kStride = kLanes * kBlock;

// x^exponent modulo the polynomial, in the order of bits that the carry-less product of reflected numbers needs.
constexpr std::uint64_t calc_power(int exponent) {
  std::uint64_t remainder = 1;
  for (int i = 0; i < exponent; ++i) {
    remainder <<= 1;
    if (remainder >> 32 & 1) remainder ^= 0x104C11DB7;
  }
  std::uint64_t reflected = 0;
  for (int bit = 0; bit < 32; ++bit) reflected |= (remainder >> bit & 1) << (31 - bit);
  return reflected << 1;
}

// What moves a block so many bits ahead of where it stands.
template <int bits>
__attribute__((target("pclmul,sse4.1"))) __m128i factors() {
  return _mm_set_epi64x(static_cast<long long>(calc_power(bits - 32)), static_cast<long long>(calc_power(bits + 32)));
}

__attribute__((target("pclmul,sse4.1"))) __m128i load_block(const std::byte* bytes) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
}

__attribute__((target("pclmul,sse4.1"))) __m128i fold(__m128i block, __m128i factor, __m128i next) {
  const __m128i low = _mm_clmulepi64_si128(block, factor, 0x00);
  const __m128i high = _mm_clmulepi64_si128(block, factor, 0x11);
  return _mm_xor_si128(_mm_xor_si128(low, high), next);
}

// Replaces everything but a tail by sixteen bytes with the same remainder: several times as fast as tables.
__attribute__((target("pclmul,sse4.1"))) std::uint32_t crc32_by_folding(Bytes bytes, std::uint32_t start) {
  __m128i lanes[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = load_block(bytes.data() + i * kBlock);
  lanes[0] = _mm_xor_si128(lanes[0], _mm_cvtsi32_si128(static_cast<int>(~start)));
  bytes = bytes.subspan(kStride);
  for (; bytes.size() >= kStride; bytes = bytes.subspan(kStride)) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes[i] = fold(lanes[i], factors<8 * kStride>(), load_block(bytes.data() + i * kBlock));
    }
  }
  for (std::size_t i = 1; i < kLanes; ++i) lanes[i] = fold(lanes[i - 1], factors<8 * kBlock>(), lanes[i]);
  std::byte rest[kBlock];
  _mm_storeu_si128(reinterpret_cast<__m128i*>(rest), lanes[kLanes - 1]);
  // zlib inverts at both ends: the start of all ones is a register of zeros.
  return crc32_by_zlib(bytes, crc32_by_zlib(rest, ~std::uint32_t{0}));
}

#endif

}  // namespace

std::uint32_t crc32(Bytes bytes, std::uint32_t start) {
  if (bytes.empty()) return start;  // zlib reads a null pointer as "give me the initial value"
#if defined(__x86_64__)
  static const bool folds = __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("sse4.1");
  if (folds && bytes.size() >= kStride) return crc32_by_folding(bytes, start);
#endif
  return crc32_by_zlib(bytes, start);
}

std::uint32_t crc32_join(std::uint32_t first, std::uint32_t second, std::uint64_t second_bytes) {
  return static_cast<std::uint32_t>(::crc32_combine(first, second, static_cast<z_off_t>(second_bytes)));
}

}  // namespace flexcast::mcap
