#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

/// Soundings on a grid: what the soundings of each cell come to.
namespace ensonify::survey_grid {

/// What is kept of the soundings of one cell: sums, so that order changes nothing but rounding.
class CellSums {
 public:
  /// `sd_m`: standard deviation of the sounding, as it is stated; NaN: not stated. Only stated ones have a weight.
  void add(double depth_m, double sd_m);

  std::uint32_t count() const { return count_; }
  bool weighted() const { return weights_ > 0.0; }
  // Of no soundings: NaN.
  double mean_m() const;
  double shoalest_m() const;
  double deepest_m() const;
  /// Of the soundings about their mean, with n - 1; NaN of fewer than two.
  double sd_m() const;
  /// Weighted by 1 / sd^2; the plain mean where no sounding states its own.
  double weighted_m() const;
  /// Root mean square of the stated standard deviations; NaN where none is stated. It does not fall with their number,
  /// for most of what makes up a sounding's uncertainty (mounting, tide, draught, sound speed) its neighbours share.
  double stated_sd_m() const;
  /// Uncertainty of the depth, 95 %: 1.96 times the larger of what is stated and what is observed.
  double uncertainty_m() const;

 private:
  std::uint32_t count_ = 0, stated_ = 0;
  double first_m_ = 0.0;                   // differences to it are summed: no digits are lost in deep water
  double sum_m_ = 0.0, squares_m2_ = 0.0;  // of the differences
  double least_m_ = 0.0, most_m_ = 0.0;    // of the depths
  double weights_ = 0.0, weighted_sum_ = 0.0, variances_m2_ = 0.0;
};

/// Square cells, their edges on whole multiples of their side from the origin of the coordinates. Room is made where
/// soundings are, in blocks of 8 by 8 cells.
class SoundingGrid {
 public:
  static constexpr std::int64_t kBlock = 8;

  /// Throws std::invalid_argument for a side that is not above 0 and finite.
  explicit SoundingGrid(double cell_m);

  /// Depth positive down. Nothing happens with a position or a depth that is not finite.
  void add(double east_m, double north_m, double depth_m, double sd_m);

  /// The smallest rectangle of cells with soundings; columns count to the east, rows to the north.
  struct Frame {
    std::int64_t first_column = 0, first_row = 0;
    std::int64_t columns = 0, rows = 0;  // 0: no sounding
  };
  Frame frame() const;

  double cell_m() const { return cell_m_; }
  std::uint64_t soundings() const { return soundings_; }
  /// Memory that the cells take.
  std::uint64_t bytes() const { return blocks_.size() * sizeof(Block); }
  /// A cell without soundings where there is none.
  const CellSums& at(std::int64_t column, std::int64_t row) const;
  /// Calls see(column, row, sums) for each cell that has soundings, southern blocks and western blocks first.
  template <class See>
  void each(const See& see) const {
    for (const auto& [at, block] : blocks_) {
      for (std::int64_t i = 0; i < kBlock * kBlock; ++i) {
        const CellSums& cell = (*block)[static_cast<std::size_t>(i)];
        if (cell.count() > 0) see(at.second * kBlock + i % kBlock, at.first * kBlock + i / kBlock, cell);
      }
    }
  }

 private:
  using Block = std::array<CellSums, static_cast<std::size_t>(kBlock* kBlock)>;
  using At = std::pair<std::int64_t, std::int64_t>;  // row, column of blocks

  double cell_m_;
  std::uint64_t soundings_ = 0;
  std::map<At, std::unique_ptr<Block>> blocks_;
  std::pair<At, Block*> last_{};  // soundings come near each other
};

}  // namespace ensonify::survey_grid
