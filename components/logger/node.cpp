#include "components/logger/node.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/errors/exit_error.h"
#include "components/formats/utc.h"
#include "messages/terrain.h"

namespace ensonify {

namespace {

constexpr Rate kEventRate{10, 1};

/// As instruments name their files: 0000_20250601_120000_boat.all.
std::string file_name(const LoggerConfig& config) {
  const formats::DayTime time = formats::day_time(config.start_unix_ns);
  std::string ship = config.ship;
  std::replace_if(
      ship.begin(), ship.end(), [](char c) { return c == '/' || c == ' ' || c == ','; }, '-');
  return fmt::format("{:04}_{:08}_{:02}{:02}{:02}_{}.all", config.line, time.date, time.time_ms / 3'600'000,
                     time.time_ms / 60'000 % 60, time.time_ms / 1'000 % 60, ship);
}

}  // namespace

LoggerNode::LoggerNode(const Config& config, Ports& ports)
    : config_(config), ports_(ports), due_(kEventRate), file_name_(file_name(config)), log_(config, file_name_) {
  if (config.origin) world_.emplace(*config.origin);
  ports.in<msg::Soundings>("soundings", [this](const msg::Soundings& soundings) { log_.take(soundings); });
  ports.in<msg::SeabedImage>("seabed_image", [this](const msg::SeabedImage& image) { log_.take(image); },
                             {.optional = true});
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { log_.take(estimate); });
  ports.in<msg::Attitude>("attitude", [this](const msg::Attitude& attitude) { log_.take(attitude); });
  ports.in<msg::Position>("position", [this](const msg::Position& position) { log_.take(position); });
  if (!world_) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) {
      world_.emplace(frames::Geodetic{chart.origin_latitude_deg, chart.origin_longitude_deg});
    });
  }
}

/// The mounting is that of the head whose soundings come in.
void LoggerNode::check_head() const {
  for (const Feed& feed : ports_.feeds()) {
    if (feed.type != msg::Soundings::kType) continue;
    const std::string head = feed.topic.substr(0, feed.topic.find('/'));
    if (head != config_.head && head != "given") {
      throw UserError(fmt::format("{}: head: is {}, but the soundings are those of {}; wire {}/soundings, or name {}",
                                  ports_.process(), config_.head, head, config_.head, head));
    }
  }
}

SimTime LoggerNode::step(SimTime now) {
  if (due_.count() == 0) check_head();
  due_.due(now);
  if (world_) put(log_.due(*world_));
  if (log_.pings_left_out() > counted_) ports_.count("pings_left_out", log_.pings_left_out() - counted_);
  counted_ = log_.pings_left_out();
  return due_.next();
}

void LoggerNode::put(const formats::Bytes& bytes) {
  if (bytes.empty()) return;
  if (!file_) file_.emplace(ports_.out_dir() / config_.folder / file_name_, record::RecordFile::How::create);
  const auto whole = file_->mark();
  try {
    file_->put(bytes);
  } catch (const DataLost&) {
    file_->cut_to(whole);  // the file ends with a whole datagram
    throw;
  }
}

void LoggerNode::finish_run() {
  if (world_) put(log_.close(*world_));
  if (file_) file_->close();
}

}  // namespace ensonify
