#include "kernels/seabed/relief/spline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ensonify::relief {
namespace {

std::int64_t half_down(std::int64_t node) { return node >> 1; }  // towards minus infinity

/// Margins of knots_of and coarser.
constexpr int kKnotMargin = 2, kCoarseBefore = 1, kCoarseAfter = 2;

/// Even and odd coefficients of a finer row, from three and four of a coarser one.
inline float even_of(float before, float here, float after) {
  return 0.1875F * (before + after) + 0.625F * here;  // 6, 20, 6 of 32
}
inline float odd_of(float before, float here, float next, float after) {
  return 0.03125F * (before + after) + 0.46875F * (here + next);  // 1, 15, 15, 1 of 32
}
/// The spline at a node: b(0) = 66 / 120, b(1) = 26 / 120, b(2) = 1 / 120.
inline float spline_of(float a, float b, float c, float d, float e) {
  return (1.0F / 120.0F) * (a + e) + (26.0F / 120.0F) * (b + d) + (66.0F / 120.0F) * c;
}

}  // namespace

Window knots_of(const Window& posts) {
  return {posts.level, posts.east - kKnotMargin, posts.north - kKnotMargin, posts.columns + 2 * kKnotMargin,
          posts.rows + 2 * kKnotMargin};
}

Window coarser(const Window& fine) {
  const std::int64_t east = half_down(fine.east) - kCoarseBefore, north = half_down(fine.north) - kCoarseBefore;
  const std::int64_t last_east = half_down(fine.east + fine.columns - 1) + kCoarseAfter;
  const std::int64_t last_north = half_down(fine.north + fine.rows - 1) + kCoarseAfter;
  return {fine.level + 1, east, north, static_cast<int>(last_east - east + 1),
          static_cast<int>(last_north - north + 1)};
}

void refine(const Grid& coarse, Grid& fine) {
  const Window& from = coarse.window;
  const Window& to = fine.window;
  fine.value.resize(to.size());
  const auto width = static_cast<std::size_t>(from.columns), pairs = width - 3;
  const auto skip = static_cast<std::size_t>(to.east & 1);  // the first pair's even coefficient may lie outside
  std::vector<float> row(width), finer(2 * pairs);
  for (int j = 0; j < to.rows; ++j) {
    const std::int64_t north = to.north + j;
    const float* a = coarse.value.data() + from.node(0, static_cast<int>(half_down(north) - 1 - from.north));
    const float *b = a + width, *c = b + width, *d = c + width;
    if ((north & 1) == 0) {
      for (std::size_t i = 0; i < width; ++i) row[i] = even_of(a[i], b[i], c[i]);
    } else {
      for (std::size_t i = 0; i < width; ++i) row[i] = odd_of(a[i], b[i], c[i], d[i]);
    }
    for (std::size_t i = 0; i < pairs; ++i) {
      finer[2 * i] = even_of(row[i], row[i + 1], row[i + 2]);
      finer[2 * i + 1] = odd_of(row[i], row[i + 1], row[i + 2], row[i + 3]);
    }
    std::copy_n(finer.data() + skip, to.columns, fine.value.data() + to.node(0, j));
  }
}

void evaluate(const Grid& knots, const Window& posts, std::span<float> out) {
  const auto width = static_cast<std::size_t>(knots.window.columns), columns = static_cast<std::size_t>(posts.columns);
  std::vector<float> row(width);
  for (int j = 0; j < posts.rows; ++j) {
    const float* a = knots.value.data() + knots.window.node(0, j);
    const float *b = a + width, *c = b + width, *d = c + width, *e = d + width;
    for (std::size_t i = 0; i < width; ++i) row[i] = spline_of(a[i], b[i], c[i], d[i], e[i]);
    float* to = out.data() + posts.node(0, j);
    for (std::size_t i = 0; i < columns; ++i) to[i] = spline_of(row[i], row[i + 1], row[i + 2], row[i + 3], row[i + 4]);
  }
}

void add_white(const random::Stream& stream, float sd, std::span<const float> amplitude, const Window& window,
               std::span<float> numbers) {
  // A row is cut into chunks of 128 nodes at fixed places; node 32 w + i of a chunk has word w of block i.
  constexpr int kBlocks = static_cast<int>(random::Stream::Run::kSize), kChunk = 4 * kBlocks;
  // A word's two halves are independent uniform numbers; their sum has variance (65536^2 - 1) / 6.
  const float scale = sd * static_cast<float>(std::sqrt(6.0 / (65536.0 * 65536.0 - 1.0)));
  random::Stream::Run bits;
  std::array<float, kChunk> white;
  const std::int64_t first_chunk = window.east >> 7, last_chunk = (window.east + window.columns - 1) >> 7;
  static_assert(kChunk == 1 << 7);
  for (int j = 0; j < window.rows; ++j) {
    const std::int64_t north = window.north + j;
    const std::uint64_t line =
        (static_cast<std::uint64_t>(window.level) << 48) ^ (static_cast<std::uint64_t>(north) & 0xffffffffffffULL);
    for (std::int64_t chunk = first_chunk; chunk <= last_chunk; ++chunk) {
      stream.run(line, static_cast<std::uint64_t>(chunk * kBlocks), bits);
      for (std::size_t w = 0; w < 4; ++w) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(kBlocks); ++i) {
          const std::uint32_t word = bits.word[w][i];
          const auto sum = static_cast<std::int32_t>((word & 0xffffU) + (word >> 16));
          white[w * static_cast<std::size_t>(kBlocks) + i] = scale * static_cast<float>(sum - 65535);
        }
      }
      const std::int64_t begin = std::max(window.east, chunk * kChunk);
      const std::int64_t end = std::min(window.east + window.columns, (chunk + 1) * kChunk);
      const float* from = white.data() + (begin - chunk * kChunk);
      const std::size_t place = window.node(static_cast<int>(begin - window.east), j);
      const auto count = static_cast<std::size_t>(end - begin);
      float* to = numbers.data() + place;
      if (amplitude.empty()) {
        for (std::size_t i = 0; i < count; ++i) to[i] += from[i];
      } else {
        const float* by = amplitude.data() + place;
        for (std::size_t i = 0; i < count; ++i) to[i] += by[i] * from[i];
      }
    }
  }
}

}  // namespace ensonify::relief
