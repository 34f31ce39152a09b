#include "tools/console/survey.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/base/frames/attitude.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify::console {

namespace {

constexpr std::int64_t kSide = survey_grid::SoundingGrid::kBlock;

std::int64_t block_of(double coordinate_m, double cell_m) {
  return static_cast<std::int64_t>(std::floor(std::floor(coordinate_m / cell_m) / static_cast<double>(kSide)));
}

}  // namespace

double cell_for(double depth_m) {
  const double wanted_m = std::max(0.1, depth_m / 50.0);
  const double decade_m = std::pow(10.0, std::floor(std::log10(wanted_m) + 1e-9));
  for (const double step : {1.0, 2.0, 5.0})
    if (wanted_m <= step * decade_m * (1.0 + 1e-9)) return step * decade_m;
  return 10.0 * decade_m;
}

void Survey::take(const std::string& type, const msg::Packet& packet) {
  const bool soundings = type == msg::Soundings::kType;
  const bool estimate = type == msg::Estimate::kType;
  if (!soundings && !estimate && type != msg::Pose::kType) return;
  if (epoch_ && *epoch_ != packet.envelope.epoch) clear();
  epoch_ = packet.envelope.epoch;
  if (soundings) {
    add(msg::decode<msg::Soundings>(packet.body, packet.body.size()));
  } else if (estimate) {
    const auto state = msg::decode<msg::Estimate>(packet.body, packet.body.size());
    add(packet.topic, false, state.stamp_ns, state.position_enu_m, state.enu_from_body);
  } else {
    const auto pose = msg::decode<msg::Pose>(packet.body, packet.body.size());
    add(packet.topic, true, pose.stamp_ns, pose.position_enu_m, pose.enu_from_body);
  }
}

void Survey::clear() {
  const std::int64_t next = generation_ + 1;
  *this = Survey();
  generation_ = next;
}

void Survey::add(const msg::Soundings& soundings) {
  const auto& places = soundings.position_enu_m;
  const std::size_t count = soundings.valid.size();
  if (places.cols() != 3 || places.rows() != count) return;
  double sum_m = 0.0;
  std::size_t valid = 0;
  const auto is_valid = [&](std::size_t i) {
    return soundings.valid[i] == 1 && std::isfinite(places(i, 0)) && std::isfinite(places(i, 1)) &&
           std::isfinite(places(i, 2));
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_valid(i)) continue;
    sum_m -= places(i, 2);
    ++valid;
  }
  if (valid == 0) return;
  if (!grid_) {
    grid_ = std::make_unique<survey_grid::SoundingGrid>(cell_for(sum_m / static_cast<double>(valid)));
    since_ns_ = soundings.stamp_ns;
  }
  ++change_;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_valid(i)) continue;
    grid_->add(places(i, 0), places(i, 1), -places(i, 2), std::numeric_limits<double>::quiet_NaN());
    const Block block{block_of(places(i, 1), grid_->cell_m()), block_of(places(i, 0), grid_->cell_m())};
    std::uint64_t& last = changed_[block];
    if (last == change_) continue;
    in_order_.erase({last, block});
    last = change_;
    in_order_.insert({change_, block});
  }
}

void Survey::add(const std::string& topic, bool truth, std::int64_t stamp_ns,
                 const std::array<double, 3>& position_enu_m, const std::array<double, 4>& enu_from_body) {
  if (!std::isfinite(position_enu_m[0]) || !std::isfinite(position_enu_m[1])) return;
  Track& track = tracks_[topic];
  track.truth = truth;
  track.stamp_ns = stamp_ns;
  track.position_enu_m = position_enu_m;
  const Eigen::Quaterniond rotation(enu_from_body[0], enu_from_body[1], enu_from_body[2], enu_from_body[3]);
  if (rotation.squaredNorm() > 0.5) track.heading_rad = frames::attitude_of(rotation.normalized()).heading_rad;
  const std::array<double, 2> here{position_enu_m[0], position_enu_m[1]};
  if (!track.points.empty() &&
      std::hypot(here[0] - track.points.back()[0], here[1] - track.points.back()[1]) < kApart_m)
    return;
  track.points.push_back(here);
}

void Survey::renew(Seen& seen) const {
  if (seen.generation != generation_) seen = {generation_, 0, {}};
}

std::optional<msg::ConsoleCells> Survey::new_cells(Seen& seen) const {
  renew(seen);
  if (!grid_) return std::nullopt;
  std::vector<Block> blocks;
  std::uint64_t reached = seen.cells;
  // Whole changes only, so that the next message begins where this ends.
  for (auto it = in_order_.lower_bound({seen.cells + 1, Block{INT64_MIN, INT64_MIN}}); it != in_order_.end(); ++it) {
    if (blocks.size() >= kMostBlocks && it->first != reached) break;
    blocks.push_back(it->second);
    reached = it->first;
  }
  if (blocks.empty()) return std::nullopt;
  seen.cells = reached;

  std::vector<std::int32_t> column, row;
  std::vector<std::uint32_t> count;
  std::vector<float> mean, shoalest, sd;
  for (const auto& [block_row, block_column] : blocks) {
    for (std::int64_t i = 0; i < kSide * kSide; ++i) {
      const std::int64_t x = block_column * kSide + i % kSide, y = block_row * kSide + i / kSide;
      const survey_grid::CellSums& cell = grid_->at(x, y);
      if (cell.count() == 0) continue;
      column.push_back(static_cast<std::int32_t>(x));
      row.push_back(static_cast<std::int32_t>(y));
      count.push_back(cell.count());
      mean.push_back(static_cast<float>(cell.mean_m()));
      shoalest.push_back(static_cast<float>(cell.shoalest_m()));
      sd.push_back(static_cast<float>(cell.sd_m()));
    }
  }
  msg::ConsoleCells cells;
  cells.generation = generation_;
  cells.since_ns = since_ns_.value_or(0);
  cells.cell_m = grid_->cell_m();
  cells.column = msg::Array<std::int32_t>::of(std::move(column));
  cells.row = msg::Array<std::int32_t>::of(std::move(row));
  cells.count = msg::Array<std::uint32_t>::of(std::move(count));
  cells.mean_depth_m = msg::Array<float>::of(std::move(mean));
  cells.shoalest_depth_m = msg::Array<float>::of(std::move(shoalest));
  cells.sd_m = msg::Array<float>::of(std::move(sd));
  return cells;
}

std::vector<msg::ConsoleTrack> Survey::new_tracks(Seen& seen) const {
  renew(seen);
  std::vector<msg::ConsoleTrack> news;
  for (const auto& [topic, track] : tracks_) {
    std::size_t& known = seen.points[topic];
    const std::size_t count = std::min(track.points.size() - known, kMostPoints);
    msg::ConsoleTrack fresh{generation_,
                            topic,
                            track.truth,
                            track.stamp_ns,
                            track.position_enu_m,
                            track.heading_rad,
                            static_cast<std::int64_t>(known),
                            msg::Array<double>({count, 2})};
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t axis = 0; axis < 2; ++axis) fresh.point_enu_m(i, axis) = track.points[known + i][axis];
    known += count;
    news.push_back(std::move(fresh));
  }
  return news;
}

}  // namespace ensonify::console
