// Vectors of doubles for kernels, compiled once for each instruction set: include it between HWY_BEFORE_NAMESPACE and
// foreach_target.h's other files as Highway's "-inl.h" files are. A batch has eight lanes; an instruction set with
// fewer takes it in parts, lane by lane the same operations, so that all with fused multiply-add give the same bits.
// Nothing in here may use Eigen or the standard library: their templates would be compiled for one instruction set and
// could be linked into code for another.
#if defined(FLEXCAST_BASE_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLEXCAST_BASE_SIMD_INL_H
#undef FLEXCAST_BASE_SIMD_INL_H
#else
#define FLEXCAST_BASE_SIMD_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace flexcast {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Loops over parts of an element keep vectors in registers only when they are written out.
#undef FLEXCAST_UNROLL
#define FLEXCAST_UNROLL _Pragma("GCC unroll 10")

constexpr int batch_lanes = 8;
using Lanes = hn::CappedTag<double, batch_lanes>;
constexpr int lane_count = static_cast<int>(hn::MaxLanes(Lanes()));

// One number a lane.
struct Real {
  hn::Vec<Lanes> v;

  Real() = default;
  HWY_INLINE Real(hn::Vec<Lanes> vector) : v(vector) {}
  HWY_INLINE Real(double value) : v(hn::Set(Lanes(), value)) {}
};

HWY_INLINE Real operator+(Real a, Real b) {
  return hn::Add(a.v, b.v);
}
HWY_INLINE Real operator-(Real a, Real b) {
  return hn::Sub(a.v, b.v);
}
HWY_INLINE Real operator*(Real a, Real b) {
  return hn::Mul(a.v, b.v);
}
HWY_INLINE Real operator/(Real a, Real b) {
  return hn::Div(a.v, b.v);
}
HWY_INLINE Real operator-(Real a) {
  return hn::Neg(a.v);
}
HWY_INLINE Real sqrt(Real a) {
  return hn::Sqrt(a.v);
}
HWY_INLINE Real max(Real a, Real b) {
  return hn::Max(a.v, b.v);
}
// a b + c and c - a b, rounded once.
HWY_INLINE Real fma(Real a, Real b, Real c) {
  return hn::MulAdd(a.v, b.v, c.v);
}
HWY_INLINE Real fnma(Real a, Real b, Real c) {
  return hn::NegMulAdd(a.v, b.v, c.v);
}

HWY_INLINE Real load(const double* from) {
  return hn::Load(Lanes(), from);
}
HWY_INLINE void store(Real a, double* to) {
  hn::Store(a.v, Lanes(), to);
}

HWY_INLINE Real load_unaligned(const double* from) {
  return hn::LoadU(Lanes(), from);
}
HWY_INLINE void store_unaligned(Real a, double* to) {
  hn::StoreU(a.v, Lanes(), to);
}

struct Vec {
  Real x, y, z;
};

HWY_INLINE Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vec operator*(Real s, const Vec& a) {
  return {s * a.x, s * a.y, s * a.z};
}
HWY_INLINE Vec fma(Real s, const Vec& a, const Vec& b) {
  return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
}
HWY_INLINE Real dot(const Vec& a, const Vec& b) {
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
HWY_INLINE Vec cross(const Vec& a, const Vec& b) {
  return {fnma(a.z, b.y, a.y * b.z), fnma(a.x, b.z, a.z * b.x), fnma(a.y, b.x, a.x * b.y)};
}

// Columns.
struct Mat {
  Vec c0, c1, c2;
};

HWY_INLINE Mat operator+(const Mat& A, const Mat& B) {
  return {A.c0 + B.c0, A.c1 + B.c1, A.c2 + B.c2};
}
HWY_INLINE Mat operator-(const Mat& A, const Mat& B) {
  return {A.c0 - B.c0, A.c1 - B.c1, A.c2 - B.c2};
}
HWY_INLINE Mat operator*(Real s, const Mat& A) {
  return {s * A.c0, s * A.c1, s * A.c2};
}
HWY_INLINE Mat fma(Real s, const Mat& A, const Mat& B) {
  return {fma(s, A.c0, B.c0), fma(s, A.c1, B.c1), fma(s, A.c2, B.c2)};
}
// A + s I.
HWY_INLINE Mat add_to_diagonal(const Mat& A, Real s) {
  return {{A.c0.x + s, A.c0.y, A.c0.z}, {A.c1.x, A.c1.y + s, A.c1.z}, {A.c2.x, A.c2.y, A.c2.z + s}};
}
HWY_INLINE Vec operator*(const Mat& A, const Vec& b) {
  return fma(b.x, A.c0, fma(b.y, A.c1, b.z * A.c2));
}
HWY_INLINE Mat operator*(const Mat& A, const Mat& B) {
  return {A * B.c0, A * B.c1, A * B.c2};
}
HWY_INLINE Vec choose(hn::Mask<Lanes> first, const Vec& a, const Vec& b) {
  return {hn::IfThenElse(first, a.x.v, b.x.v), hn::IfThenElse(first, a.y.v, b.y.v),
          hn::IfThenElse(first, a.z.v, b.z.v)};
}
HWY_INLINE Mat choose(hn::Mask<Lanes> first, const Mat& A, const Mat& B) {
  return {choose(first, A.c0, B.c0), choose(first, A.c1, B.c1), choose(first, A.c2, B.c2)};
}
// a b^T.
HWY_INLINE Mat outer(const Vec& a, const Vec& b) {
  return {b.x * a, b.y * a, b.z * a};
}
HWY_INLINE Mat transpose(const Mat& A) {
  return {{A.c0.x, A.c1.x, A.c2.x}, {A.c0.y, A.c1.y, A.c2.y}, {A.c0.z, A.c1.z, A.c2.z}};
}
HWY_INLINE Real trace(const Mat& A) {
  return A.c0.x + A.c1.y + A.c2.z;
}
HWY_INLINE Real dot(const Mat& A, const Mat& B) {
  return dot(A.c0, B.c0) + dot(A.c1, B.c1) + dot(A.c2, B.c2);
}
HWY_INLINE Mat calc_cofactor(const Mat& A) {
  return {cross(A.c1, A.c2), cross(A.c2, A.c0), cross(A.c0, A.c1)};
}
// A^T A, whole.
HWY_INLINE Mat calc_gram(const Mat& A) {
  const Real xy = dot(A.c0, A.c1), xz = dot(A.c0, A.c2), yz = dot(A.c1, A.c2);
  return {{dot(A.c0, A.c0), xy, xz}, {xy, dot(A.c1, A.c1), yz}, {xz, yz, dot(A.c2, A.c2)}};
}
// (A + A^T) / 2.
HWY_INLINE Mat calc_symmetric(const Mat& A) {
  const Real half = 0.5;
  const Real xy = half * (A.c0.y + A.c1.x), xz = half * (A.c0.z + A.c2.x), yz = half * (A.c1.z + A.c2.y);
  return {{A.c0.x, xy, xz}, {xy, A.c1.y, yz}, {xz, yz, A.c2.z}};
}

// Nine runs of batch_lanes numbers, column by column; `from` at the first lane of the part.
HWY_INLINE Mat load_mat(const double* from) {
  constexpr int n = batch_lanes;
  return {{load(from), load(from + n), load(from + 2 * n)},
          {load(from + 3 * n), load(from + 4 * n), load(from + 5 * n)},
          {load(from + 6 * n), load(from + 7 * n), load(from + 8 * n)}};
}
HWY_INLINE void store_mat(const Mat& A, double* to) {
  constexpr int n = batch_lanes;
  const Real entries[9] = {A.c0.x, A.c0.y, A.c0.z, A.c1.x, A.c1.y, A.c1.z, A.c2.x, A.c2.y, A.c2.z};
  for (int i = 0; i < 9; ++i) store(entries[i], to + i * n);
}

// Where a vector of four doubles begins: small places say it, numbers count vectors.
HWY_INLINE std::int64_t find_begin(std::uint16_t place) {
  return place;
}
HWY_INLINE std::int64_t find_begin(std::int32_t number) {
  return 4 * static_cast<std::int64_t>(number);
}

// Vectors of four doubles, one a lane: lane i of a, b, c, d is in row i, or with eight lanes rows 0 to 3 hold those of
// the lanes i (lower half) and i + 4 (upper half).
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
using Four = hn::FixedTag<double, 4>;
struct Rows {
  hn::Vec<Lanes> r0, r1, r2, r3;
};

#if HWY_TARGET == HWY_AVX3
HWY_INLINE hn::Vec<Four> lower_half(hn::Vec<Lanes> row) {
  return hn::LowerHalf(Four(), row);
}
HWY_INLINE hn::Vec<Four> upper_half(hn::Vec<Lanes> row) {
  return hn::UpperHalf(Four(), row);
}
#else
HWY_INLINE hn::Vec<Four> lower_half(hn::Vec<Lanes> row) {
  return row;
}
#endif

template <class Place>
HWY_INLINE hn::Vec<Lanes> load_row(const double* array, const Place* places, int i) {
  const auto lower = hn::Load(Four(), array + find_begin(places[i]));
#if HWY_TARGET == HWY_AVX3
  return hn::Combine(Lanes(), hn::Load(Four(), array + find_begin(places[i + 4])), lower);
#else
  return lower;
#endif
}

HWY_INLINE Rows turn(Real a, Real b, Real c, Real d) {
  const auto ab_even = hn::InterleaveLower(Lanes(), a.v, b.v), ab_odd = hn::InterleaveUpper(Lanes(), a.v, b.v);
  const auto cd_even = hn::InterleaveLower(Lanes(), c.v, d.v), cd_odd = hn::InterleaveUpper(Lanes(), c.v, d.v);
  return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd_even), ab_even),
          hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd_odd), ab_odd),
          hn::OddEvenBlocks(cd_even, hn::SwapAdjacentBlocks(ab_even)),
          hn::OddEvenBlocks(cd_odd, hn::SwapAdjacentBlocks(ab_odd))};
}

HWY_INLINE void add_row(hn::Vec<Four> row, double* to) {
  hn::Store(hn::Add(hn::Load(Four(), to), row), Four(), to);
}
#endif

// The vectors at places[lane] of an array of x, y, z, 0; places are those of the part's first lane on.
template <class Place>
HWY_INLINE Vec load_nodes(const double* array, const Place* places) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  const auto r0 = load_row(array, places, 0), r1 = load_row(array, places, 1);
  const auto r2 = load_row(array, places, 2), r3 = load_row(array, places, 3);
  const auto xz01 = hn::InterleaveLower(Lanes(), r0, r1), xz23 = hn::InterleaveLower(Lanes(), r2, r3);
  const auto y01 = hn::InterleaveUpper(Lanes(), r0, r1), y23 = hn::InterleaveUpper(Lanes(), r2, r3);
  return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(xz23), xz01), hn::OddEvenBlocks(hn::SwapAdjacentBlocks(y23), y01),
          hn::OddEvenBlocks(xz23, hn::SwapAdjacentBlocks(xz01))};
#else
  HWY_ALIGN double x[lane_count], y[lane_count], z[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* from = array + find_begin(places[lane]);
    x[lane] = from[0];
    y[lane] = from[1];
    z[lane] = from[2];
  }
  return {load(x), load(y), load(z)};
#endif
}

// A row of four doubles a lane: x, y, z, 0.
HWY_INLINE void store_rows(const Vec& a, double* to) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  const Rows rows = turn(a.x, a.y, a.z, Real(0.0));
  hn::Store(lower_half(rows.r0), Four(), to);
  hn::Store(lower_half(rows.r1), Four(), to + 4);
  hn::Store(lower_half(rows.r2), Four(), to + 8);
  hn::Store(lower_half(rows.r3), Four(), to + 12);
#if HWY_TARGET == HWY_AVX3
  hn::Store(upper_half(rows.r0), Four(), to + 16);
  hn::Store(upper_half(rows.r1), Four(), to + 20);
  hn::Store(upper_half(rows.r2), Four(), to + 24);
  hn::Store(upper_half(rows.r3), Four(), to + 28);
#endif
#else
  HWY_ALIGN double x[lane_count], y[lane_count], z[lane_count];
  store(a.x, x);
  store(a.y, y);
  store(a.z, z);
  for (int lane = 0; lane < lane_count; ++lane) {
    to[4 * lane] = x[lane];
    to[4 * lane + 1] = y[lane];
    to[4 * lane + 2] = z[lane];
  }
#endif
}

// A sum of such rows.
struct FourSum {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  hn::Vec<Four> sum;
  HWY_INLINE FourSum() : sum(hn::Zero(Four())) {}
  HWY_INLINE void add(const double* row) {
    sum = hn::Add(sum, hn::Load(Four(), row));
  }
  HWY_INLINE void subtract(const double* row) {
    sum = hn::Sub(sum, hn::Load(Four(), row));
  }
  HWY_INLINE void store_three(double* to) const {
    using Two = hn::FixedTag<double, 2>;
    hn::StoreU(hn::LowerHalf(Two(), sum), Two(), to);
    to[2] = hn::GetLane(hn::UpperHalf(Two(), sum));
  }
#else
  double x = 0.0, y = 0.0, z = 0.0;
  HWY_INLINE void add(const double* row) {
    x += row[0], y += row[1], z += row[2];
  }
  HWY_INLINE void subtract(const double* row) {
    x -= row[0], y -= row[1], z -= row[2];
  }
  HWY_INLINE void store_three(double* to) const {
    to[0] = x, to[1] = y, to[2] = z;
  }
#endif
};

// The vectors that begin at array + places[node * batch_lanes + lane] += vectors[node].
template <int nodes>
HWY_INLINE void add_to_nodes(const Vec (&vectors)[nodes], const std::uint16_t* places, double* array) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  for (int a = 0; a < nodes; ++a) {
    const Rows rows = turn(vectors[a].x, vectors[a].y, vectors[a].z, Real(0.0));
    const std::uint16_t* to = places + a * batch_lanes;
    add_row(lower_half(rows.r0), array + to[0]);
    add_row(lower_half(rows.r1), array + to[1]);
    add_row(lower_half(rows.r2), array + to[2]);
    add_row(lower_half(rows.r3), array + to[3]);
#if HWY_TARGET == HWY_AVX3
    add_row(upper_half(rows.r0), array + to[4]);
    add_row(upper_half(rows.r1), array + to[5]);
    add_row(upper_half(rows.r2), array + to[6]);
    add_row(upper_half(rows.r3), array + to[7]);
#endif
  }
#else
  for (int a = 0; a < nodes; ++a) {
    HWY_ALIGN double x[lane_count], y[lane_count], z[lane_count];
    store(vectors[a].x, x);
    store(vectors[a].y, y);
    store(vectors[a].z, z);
    for (int lane = 0; lane < lane_count; ++lane) {
      double* to = array + places[a * batch_lanes + lane];
      to[0] += x[lane];
      to[1] += y[lane];
      to[2] += z[lane];
    }
  }
#endif
}

// Nine entries a lane, column by column, as rows of eight and the ninth apart.
HWY_INLINE void store_blocks(const Mat& A, double* rows, double* lasts) {
  store(A.c2.z, lasts);
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  const Rows first = turn(A.c0.x, A.c0.y, A.c0.z, A.c1.x), second = turn(A.c1.y, A.c1.z, A.c2.x, A.c2.y);
  hn::Store(lower_half(first.r0), Four(), rows);
  hn::Store(lower_half(second.r0), Four(), rows + 4);
  hn::Store(lower_half(first.r1), Four(), rows + 8);
  hn::Store(lower_half(second.r1), Four(), rows + 12);
  hn::Store(lower_half(first.r2), Four(), rows + 16);
  hn::Store(lower_half(second.r2), Four(), rows + 20);
  hn::Store(lower_half(first.r3), Four(), rows + 24);
  hn::Store(lower_half(second.r3), Four(), rows + 28);
#if HWY_TARGET == HWY_AVX3
  hn::Store(upper_half(first.r0), Four(), rows + 32);
  hn::Store(upper_half(second.r0), Four(), rows + 36);
  hn::Store(upper_half(first.r1), Four(), rows + 40);
  hn::Store(upper_half(second.r1), Four(), rows + 44);
  hn::Store(upper_half(first.r2), Four(), rows + 48);
  hn::Store(upper_half(second.r2), Four(), rows + 52);
  hn::Store(upper_half(first.r3), Four(), rows + 56);
  hn::Store(upper_half(second.r3), Four(), rows + 60);
#endif
#else
  const Real eight[8] = {A.c0.x, A.c0.y, A.c0.z, A.c1.x, A.c1.y, A.c1.z, A.c2.x, A.c2.y};
  for (int k = 0; k < 8; ++k) {
    HWY_ALIGN double lanes[lane_count];
    store(eight[k], lanes);
    for (int lane = 0; lane < lane_count; ++lane) rows[8 * lane + k] = lanes[lane];
  }
#endif
}

// A sum of such.
struct NineSum {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  hn::Vec<Four> first, second;
  double last = 0.0;
  HWY_INLINE NineSum() : first(hn::Zero(Four())), second(hn::Zero(Four())) {}
  HWY_INLINE void add(const double* row, double ninth) {
    first = hn::Add(first, hn::Load(Four(), row));
    second = hn::Add(second, hn::Load(Four(), row + 4));
    last += ninth;
  }
  HWY_INLINE void store(double* to) const {
    hn::Store(first, Four(), to);
    hn::Store(second, Four(), to + 4);
    to[8] = last;
  }
#else
  double sums[9] = {};
  HWY_INLINE void add(const double* row, double ninth) {
    for (int k = 0; k < 8; ++k) sums[k] += row[k];
    sums[8] += ninth;
  }
  HWY_INLINE void store(double* to) const {
    for (int k = 0; k < 9; ++k) to[k] = sums[k];
  }
#endif
};

// A sum a lane, added up in the order of the lanes.
struct LaneSums {
  HWY_ALIGN double lanes[batch_lanes] = {};

  HWY_INLINE void add(int part, Real value) { store(load(lanes + part) + value, lanes + part); }
  HWY_INLINE double total() const {
    double sum = 0.0;
    for (const double lane : lanes) sum += lane;
    return sum;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace flexcast
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
