#include "kernels/acoustics/label/masks.h"

#include <algorithm>
#include <cmath>

namespace ensonify::label {
namespace {

constexpr float kCovered = 0.1F;  // of a cell's width, more than that

/// A body's surface in a strip, in one row.
struct Piece {
  std::int32_t row;
  std::uint32_t body;
  std::size_t strip;
  std::int32_t first, end;  // samples
  float width;              // of the strip, over the cell's
  float level_upa2;         // of each sample

  auto key() const { return std::tie(row, body, strip, first, end); }
};

/// Row whose cell holds a sine; -1: none.
std::int32_t row_of(std::span<const Row> rows, int sector, float sine) {
  const auto s = static_cast<double>(sine);
  const auto from = std::ranges::lower_bound(rows, std::pair(sector, s), {},
                                             [](const Row& row) { return std::pair(row.sector, row.upper); });
  if (from == rows.end() || from->sector != sector || s < from->lower) return -1;
  return static_cast<std::int32_t>(from - rows.begin());
}

class Pieces {
 public:
  Pieces(std::span<const Row> rows, const echo::Sampling& sampling) : rows_(rows), sampling_(sampling) {}

  /// What lies between two echoes of a body, which may be one.
  void add(const Strip& strip, std::size_t number, const RayEcho& a, const RayEcho& b, double angle_rad) {
    const std::int32_t row = row_of(rows_, strip.sector, 0.5F * (a.sine + b.sine));
    if (row < 0) return;
    const auto [least, most] = std::minmax(a.time_s, b.time_s);
    const std::int32_t first = sample_at(sampling_, least), end = sample_at(sampling_, most) + 1;
    const Row& in = rows_[static_cast<std::size_t>(row)];
    const double sent = 0.5 * static_cast<double>(a.level_upa2 + b.level_upa2) * angle_rad * strip.width;
    if (end <= 0 || first >= sampling_.count) return;
    pieces_.push_back({row, a.contributor, number, std::max(first, 0), std::min(end, sampling_.count),
                       static_cast<float>(strip.width / (in.upper - in.lower)),
                       static_cast<float>(sent / static_cast<double>(end - first))});
  }

  std::vector<Piece> sorted() && {
    std::ranges::sort(pieces_, {}, &Piece::key);
    return std::move(pieces_);
  }

 private:
  std::span<const Row> rows_;
  const echo::Sampling& sampling_;
  std::vector<Piece> pieces_;
};

/// Numbers by sample of a row; only those that were used are cleared.
struct Samples {
  explicit Samples(int count) : covered(static_cast<std::size_t>(count)), level_upa2(covered) {}
  std::vector<float> covered, level_upa2;
};

/// Covers samples with one strip's pieces: what several of them cover counts once.
void cover(std::span<const Piece> of_strip, Samples& samples) {
  std::int32_t done = 0;
  for (const Piece& piece : of_strip) {
    for (std::int32_t k = piece.first; k < piece.end; ++k)
      samples.level_upa2[static_cast<std::size_t>(k)] += piece.level_upa2;
    for (std::int32_t k = std::max(done, piece.first); k < piece.end; ++k)
      samples.covered[static_cast<std::size_t>(k)] += piece.width;
    done = std::max(done, piece.end);
  }
}

/// Calls use(part) for the neighbours among `pieces` that are alike.
template <class Alike, class Use>
void for_groups(std::span<const Piece> pieces, const Alike& alike, const Use& use) {
  while (!pieces.empty()) {
    std::size_t count = 1;
    while (count < pieces.size() && alike(pieces[0], pieces[count])) ++count;
    use(pieces.first(count));
    pieces = pieces.subspan(count);
  }
}

void append(std::uint32_t whose, std::int32_t row, std::int32_t sample, std::vector<Run>& runs) {
  if (!runs.empty() && runs.back().whose == whose && runs.back().row == row && runs.back().end == sample) {
    ++runs.back().end;
  } else {
    runs.push_back({whose, row, sample, sample + 1});
  }
}

}  // namespace

Masks find_masks(std::span<const Strip> strips, std::span<const std::vector<Point>> points, const Fineness& fineness,
                 std::span<const Row> rows, const echo::Sampling& sampling) {
  Pieces found(rows, sampling);
  for (std::size_t s = 0; s < strips.size(); ++s) {
    for (std::size_t i = 0; i < points[s].size(); ++i) {
      const RayEcho& a = points[s][i].first;
      if (!trace::is_body(a.contributor)) continue;
      found.add(strips[s], s, a, a, 0.0);
      if (i + 1 == points[s].size()) continue;
      const RayEcho& b = points[s][i + 1].first;
      if (a.contributor == b.contributor && adjoin(a, b, fineness.body_s))
        found.add(strips[s], s, a, b, points[s][i + 1].angle_rad - points[s][i].angle_rad);
    }
  }
  const std::vector<Piece> pieces = std::move(found).sorted();

  Masks masks;
  Samples samples(sampling.count);
  std::vector<float> most(samples.covered.size());
  std::vector<std::uint32_t> whose(samples.covered.size());
  for_groups(
      pieces, [](const Piece& a, const Piece& b) { return a.row == b.row; },
      [&](std::span<const Piece> in_row) {
        const std::int32_t row = in_row.front().row;
        std::ranges::fill(whose, trace::kNoise);
        for_groups(
            in_row, [](const Piece& a, const Piece& b) { return a.body == b.body; },
            [&](std::span<const Piece> of) {
              std::int32_t first = sampling.count, end = 0;
              for_groups(
                  of, [](const Piece& a, const Piece& b) { return a.strip == b.strip; },
                  [&](std::span<const Piece> of_strip) { cover(of_strip, samples); });
              for (const Piece& piece : of) first = std::min(first, piece.first), end = std::max(end, piece.end);
              for (std::int32_t k = first; k < end; ++k) {
                const auto at = static_cast<std::size_t>(k);
                if (samples.covered[at] > kCovered) {
                  append(of.front().body, row, k, masks.own);
                  if (whose[at] == trace::kNoise || samples.level_upa2[at] > most[at])
                    whose[at] = of.front().body, most[at] = samples.level_upa2[at];
                }
                samples.covered[at] = samples.level_upa2[at] = 0.0F;
              }
            });
        for (std::int32_t k = 0; k < sampling.count; ++k) {
          if (whose[static_cast<std::size_t>(k)] != trace::kNoise)
            append(whose[static_cast<std::size_t>(k)], row, k, masks.layer);
        }
      });
  std::ranges::sort(masks.own);
  return masks;
}

}  // namespace ensonify::label
