#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kernels/survey/grid/soundings.h"
#include "messages/codec.h"
#include "messages/console.h"
#include "messages/soundings.h"

namespace ensonify::console {

/// What a chart shows of a run as it goes on: all valid soundings on a grid, and the tracks of the vehicles. Viewers
/// fetch what is new to them, so that nothing waits for anybody and nothing is lost.
class Survey {
 public:
  static constexpr std::size_t kMostBlocks = 300;     // of 8 x 8 cells in one message
  static constexpr std::size_t kMostPoints = 20'000;  // of a track in one message
  static constexpr double kApart_m = 0.5;             // points of a track

  /// soundings/1, estimate/1 and pose/1; others are passed over. Another epoch begins anew.
  void take(const std::string& type, const msg::Packet& packet);

  /// Begins anew: viewers drop what they have.
  void clear();

  /// How far a viewer has come.
  struct Seen {
    std::int64_t generation = 0;
    std::uint64_t cells = 0;
    std::map<std::string, std::size_t> points;
  };
  /// What is new since then; nothing when nothing is.
  std::optional<msg::ConsoleCells> new_cells(Seen& seen) const;
  std::vector<msg::ConsoleTrack> new_tracks(Seen& seen) const;

 private:
  struct Track {
    bool truth = false;
    std::int64_t stamp_ns = 0;
    std::array<double, 3> position_enu_m{};
    double heading_rad = 0.0;
    std::vector<std::array<double, 2>> points;
  };
  using Block = std::pair<std::int64_t, std::int64_t>;  // row and column of 8 x 8 cells

  void add(const msg::Soundings& soundings);
  void add(const std::string& topic, bool truth, std::int64_t stamp_ns, const std::array<double, 3>& position_enu_m,
           const std::array<double, 4>& enu_from_body);
  void renew(Seen& seen) const;

  std::int64_t generation_ = 1;
  std::optional<std::uint32_t> epoch_;
  std::optional<std::int64_t> since_ns_;
  std::unique_ptr<survey_grid::SoundingGrid> grid_;
  std::uint64_t change_ = 0;                            // counts pings that changed cells
  std::map<Block, std::uint64_t> changed_;              // by which of them last
  std::set<std::pair<std::uint64_t, Block>> in_order_;  // the same, oldest change first
  std::map<std::string, Track> tracks_;
};

/// Side of the cells of a grid over water of this depth: a fiftieth of it, rounded up to 0.1, 0.2, 0.5, 1, ... m.
double cell_for(double depth_m);

}  // namespace ensonify::console
