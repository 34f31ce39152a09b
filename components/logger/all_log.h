#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "components/formats/all/writer.h"
#include "components/logger/config.h"
#include "components/logger/vessel.h"
#include "messages/navigation.h"
#include "messages/soundings.h"

namespace ensonify::logger {

/// Heave by time, as the motion sensor reports it, turned to positive down.
class Heave {
 public:
  void push(std::int64_t stamp_ns, double heave_up_m);
  /// On the straight line between its neighbours, at the ends the nearest; 0 while nothing is known.
  double down_m(std::int64_t stamp_ns) const;
  std::optional<std::int64_t> newest_ns() const;

 private:
  struct Sample {
    std::int64_t stamp_ns;
    double down_m;
  };
  std::deque<Sample> samples_;
};

/// The datagrams of a .all file in their order.
///
/// Navigation is kept until the first ping that has kLeastLead_ns of it before it, then the file begins: I, R, U, the
/// navigation of the last kKeptLead_ns, N X Y. Pings before that are left out.
class AllLog {
 public:
  static constexpr std::int64_t kLeastLead_ns = 1'000'000'000;
  static constexpr std::int64_t kKeptLead_ns = 2'500'000'000;
  static constexpr std::size_t kLeastPositions = 3;

  /// `file_name` is stated within the file.
  AllLog(const LoggerConfig& config, std::string file_name);

  void take(const msg::Attitude& attitude) { heave_.push(attitude.stamp_ns, attitude.heave_m); }
  void take(const msg::Position& position) { fix_ = position; }
  void take(const msg::Estimate& estimate) { estimates_.push_back(estimate); }
  void take(const msg::Soundings& soundings) { pings_.push_back(soundings); }
  void take(const msg::SeabedImage& image) { images_.push_back(image); }

  /// What can be written of all that was taken; whole datagrams. To be called when the inputs of a time are complete.
  formats::Bytes due(const frames::LocalProjection& world) { return write(world, false); }
  /// The rest, and the closing datagram; nothing where the file has not begun.
  formats::Bytes close(const frames::LocalProjection& world) { return write(world, true); }

  std::int64_t pings() const { return logged_pings_; }
  /// Pings before the file began, or without an estimate.
  std::int64_t pings_left_out() const { return left_out_; }

 private:
  struct Navigation {
    std::int64_t stamp_ns;
    formats::all::Body body;
  };

  formats::Bytes write(const frames::LocalProjection& world, bool all);
  void add(const msg::Estimate& estimate, const frames::LocalProjection& world);
  void finish_attitude();
  formats::all::Position position_of(const msg::Estimate& estimate, const frames::LocalProjection& world) const;
  bool begins(const msg::Soundings& first) const;
  void begin(const msg::Soundings& first, formats::Bytes& out);
  void write(const msg::Soundings& ping, const frames::LocalProjection& world, formats::Bytes& out);
  std::optional<msg::SeabedImage> image_of(std::int64_t ping);
  std::int64_t unix_ns(std::int64_t stamp_ns) const;

  LoggerConfig config_;
  std::string file_name_;
  formats::all::Writer writer_;
  bool begun_ = false;
  std::int64_t last_ns_ = 0;  // of what was written
  std::int64_t logged_pings_ = 0;
  std::int64_t left_out_ = 0;

  Heave heave_;
  std::optional<msg::Position> fix_;
  std::vector<msg::Estimate> estimates_;
  std::deque<msg::Soundings> pings_;
  std::deque<msg::SeabedImage> images_;

  std::deque<Navigation> navigation_;  // not written yet
  formats::all::Attitude attitude_;    // of the second that is not over
  std::int64_t attitude_begin_ns_ = 0;
  std::optional<std::int64_t> next_position_ns_;
  std::optional<std::int64_t> next_clock_ns_;
  std::optional<formats::all::Runtime> runtime_;  // as last written
};

}  // namespace ensonify::logger
