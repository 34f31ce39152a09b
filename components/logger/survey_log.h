#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/logger/format.h"
#include "components/logger/heave.h"
#include "messages/motion.h"

namespace ensonify::logger {

/// Where formats' files go. A file is opened before anything is put into it, and closed before the format's next.
class Files {
 public:
  virtual ~Files() = default;
  virtual void open(std::size_t format, const std::string& name) = 0;
  /// Whole datagrams.
  virtual void put(std::size_t format, const formats::Bytes& bytes) = 0;
  virtual void close(std::size_t format) = 0;
  /// Of the format's open file.
  virtual std::uint64_t bytes(std::size_t format) const = 0;
};

/// A survey in the order in which files have it, file after file.
///
/// Navigation is kept until the first ping that has lead_ns() of it before it, then all formats' files begin with that;
/// pings before are left out. A file after the first begins with the last of the navigation again, so that each stands
/// alone, and no ping is left out; its times lie between those of the file before, as readers of all files refuse a
/// time that comes twice.
class SurveyLog {
 public:
  SurveyLog(const LoggerConfig& config, std::vector<std::unique_ptr<Format>> formats, Files& files);

  void take(const msg::Attitude& attitude) { heave_.push(attitude.stamp_ns, attitude.heave_m); }
  void take(const msg::Position& position) { fix_ = position; }
  void take(const msg::Estimate& estimate) { estimates_.push_back(estimate); }
  void take(const msg::Soundings& soundings) { pings_.emplace_back(soundings); }
  void take(const msg::SeabedImage& image) { images_.push_back(image); }
  void take(const msg::Ping& water_column) { columns_.push_back(water_column); }
  void take(const msg::MissionState& state);
  void take(SidescanPing ping) { pings_.emplace_back(std::move(ping)); }

  /// Writes what can be written of all that was taken. To be called when the inputs of a time are complete.
  void write(const frames::LocalProjection& world) { write(world, false); }
  /// The rest; ends the files.
  void close(const frames::LocalProjection& world);

  /// Pings before the files began, or without an estimate.
  std::int64_t pings_left_out() const { return left_out_; }

 private:
  using Ping = std::variant<msg::Soundings, SidescanPing>;

  void write(const frames::LocalProjection& world, bool all);
  void add(const msg::Estimate& estimate, const frames::LocalProjection& world);
  bool begins(std::int64_t ping_ns) const;
  bool next_file_due(std::int64_t ping_ns) const;
  std::vector<Moment> lead_of_files() const;
  void start_files(const Ping& first);
  void end_files();
  void write(const Ping& ping, const frames::LocalProjection& world);
  template <class Append>
  void each_format(const Append& append);
  std::string file_name(const Format& format, std::int64_t unix_ns) const;
  std::int64_t lead_ns() const;
  std::int64_t kept_ns() const { return 5 * lead_ns() / 2; }  // of navigation, for the next files

  LoggerConfig config_;
  std::vector<std::unique_ptr<Format>> formats_;
  Files& files_;
  std::int64_t left_out_ = 0;

  Heave heave_;
  std::optional<msg::Position> fix_;
  std::vector<msg::Estimate> estimates_;
  std::deque<Ping> pings_;
  std::deque<msg::SeabedImage> images_;
  std::deque<msg::Ping> columns_;
  std::deque<Moment> lead_;  // the last of them
  std::optional<std::int64_t> next_position_ns_, next_clock_ns_;

  int files_begun_ = 0;
  std::int64_t begun_ns_ = 0;  // first ping of the open files
  std::int64_t line_ = -1;     // of the mission; -1: none
  bool line_changed_ = false;  // since the open files began
};

}  // namespace ensonify::logger
