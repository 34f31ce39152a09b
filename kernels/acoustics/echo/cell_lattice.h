#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "kernels/base/frames/pose.h"

namespace ensonify::echo {

/// Edges of cells: cubes, and from a range on long ones, of four cubes along the track. In a beam that is narrow along
/// the track yet wide on the seabed their points differ in nothing that a head resolves.
struct CellSize {
  static constexpr double kCubes = 4.0;  // to a long cell

  CellSize(double of_cubes_m) : cube_m(of_cubes_m) {}  // NOLINT(google-explicit-constructor): cubes alone
  /// Long cells are at most a quarter of what a beam of this width along the track covers of the seabed.
  static CellSize for_beam(double of_cubes_m, double along_track_rad) {
    CellSize size(of_cubes_m);
    size.long_from_m = 4.0 * kCubes * of_cubes_m / along_track_rad;
    return size;
  }

  double cube_m;
  double long_from_m = std::numeric_limits<double>::infinity();  // range
};

/// Numbers of cells: 21 bits each of their steps east, north and up; of long ones those along the track, across it and
/// 16 bits of those up, below 5 bits of their turn and one that says so. No cell has number kNoCell.
constexpr int kCellBits = 21, kLongUpBits = 16;
constexpr std::uint64_t kNoCell = ~std::uint64_t{0};

/// The cells of a ping. Cubes are those of the world. Long cells stand along the track, but at a multiple of 9 degrees:
/// pings of nearly the same course, or the opposite one, share theirs.
///
/// A hit has a long cell where its range changes by at most a tenth of the way along the cell. That holds all over a
/// fan of a degree on a turn that is 4.5 degrees off, and ranges of a long cell spread no more than those of a cube
/// that is seen over its edge.
class CellLattice {
  static constexpr int kTurns = 20;  // in half a circle

 public:
  CellLattice(const CellSize& size, const frames::HeadPose& head)
      : cube_m_(size.cube_m),
        long_from_m_(size.long_from_m),
        head_x_(head.position_enu_m.x()),
        head_y_(head.position_enu_m.y()) {
    constexpr double kStep = std::numbers::pi / kTurns;
    const frames::Vec3 forward = head.enu_from_head * frames::Vec3::UnitX();
    const auto turn = (std::lround(std::atan2(forward.y(), forward.x()) / kStep) + kTurns) % kTurns;
    along_x_ = std::cos(static_cast<double>(turn) * kStep), along_y_ = std::sin(static_cast<double>(turn) * kStep);
    long_name_ = (std::uint64_t{1} << 63) | static_cast<std::uint64_t>(turn) << (2 * kCellBits + kLongUpBits);
  }

  /// A cell: its steps, its axis along the track and its edge there.
  struct Cell {
    double along, across, up;
    double axis_x, axis_y, along_m;
    std::uint64_t number;
  };

  /// The cell of a place at this range.
  Cell cell_at(double x, double y, double z, double range_m) const {
    const double ahead_m = std::abs((x - head_x_) * along_x_ + (y - head_y_) * along_y_);
    const bool is_long = (range_m >= long_from_m_) & (10.0 * ahead_m <= range_m);
    const double axis_x = is_long ? along_x_ : 1.0, axis_y = is_long ? along_y_ : 0.0;
    const double per_cube = 1.0 / cube_m_, per_along = is_long ? per_cube / CellSize::kCubes : per_cube;
    const double along = std::floor((x * axis_x + y * axis_y) * per_along + kShift[0]),
                 across = std::floor((y * axis_x - x * axis_y) * per_cube + kShift[1]),
                 up = std::floor(z * per_cube + kShift[2]);
    const std::uint64_t up_bits = is_long ? kLongUp : kUp, name = is_long ? long_name_ : 0;
    return {along,
            across,
            up,
            axis_x,
            axis_y,
            is_long ? CellSize::kCubes * cube_m_ : cube_m_,
            steps(along) | steps(across) << kCellBits | (steps(up) & up_bits) << (2 * kCellBits) | name};
  }

  /// A place in a cell, by its shares of the edges.
  frames::Vec3 place(const Cell& cell, double along, double across, double up) const {
    const double first_m = cell.along_m * (cell.along + along - kShift[0]),
                 second_m = cube_m_ * (cell.across + across - kShift[1]);
    return {first_m * cell.axis_x - second_m * cell.axis_y, first_m * cell.axis_y + second_m * cell.axis_x,
            cube_m_ * (cell.up + up - kShift[2])};
  }

 private:
  /// A flat seabed at a round depth must not lie on the border of two layers of cells.
  static constexpr double kShift[3] = {0.3819660113, 0.6180339887, 0.2360679775};
  static constexpr std::uint64_t kUp = (std::uint64_t{1} << kCellBits) - 1,
                                 kLongUp = (std::uint64_t{1} << kLongUpBits) - 1;

  /// A number of steps modulo 2^21.
  static std::uint64_t steps(double whole) {
    constexpr double kTurn = 0x1p21;
    return static_cast<std::uint64_t>(static_cast<std::int32_t>(whole - kTurn * std::floor(whole * (1.0 / kTurn))));
  }

  double cube_m_, long_from_m_;
  double head_x_, head_y_;
  double along_x_, along_y_;  // axis of long cells
  std::uint64_t long_name_;
};

}  // namespace ensonify::echo
