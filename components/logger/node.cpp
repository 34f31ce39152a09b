#include "components/logger/node.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/errors/exit_error.h"
#include "components/logger/all_format.h"
#include "components/logger/instruments.h"
#include "components/logger/kmall/kmall_format.h"
#include "components/logger/xtf/xtf_format.h"
#include "components/runtime/declared.h"
#include "components/runtime/log.h"
#include "messages/terrain.h"

namespace ensonify {

namespace {

constexpr Rate kEventRate{10, 1};

std::optional<msg::HeadDeclaration> declared_head(const Ports& ports, const std::string& head) {
  if (head.empty()) return std::nullopt;
  const auto heads = declared<msg::HeadDeclaration>(ports.facts());
  const auto found = heads.find(head);
  return found == heads.end() ? msg::HeadDeclaration{} : found->second;  // records of before have none
}

}  // namespace

LoggerNode::LoggerNode(const Config& config, Ports& ports)
    : config_(config), ports_(ports), due_(kEventRate), files_(ports.out_dir() / config.folder) {
  if (config.origin) world_.emplace(*config.origin);
  if (!config.head.empty()) {
    ports.in<msg::Soundings>("soundings", [this](const msg::Soundings& soundings) {
      logger::check_soundings(ports_.process(), config_.formats, config_.head, soundings.beam_angle_rad.size());
      log().take(soundings);
    });
    ports.in<msg::SeabedImage>("seabed_image", [this](const msg::SeabedImage& image) { log().take(image); },
                               {.optional = true});
    if (config.water_column()) {
      ports.in_topics<msg::Ping>("water_column", {config.head + "/ping"},
                                 [this](const std::string&, const msg::Ping& ping) { log().take(ping); });
    }
  }
  if (!config.sidescan.empty()) {
    const std::vector<std::string> all{config.sidescan + "/*"};
    ports.in_topics<msg::Ping>("sidescan", all, [this](const std::string&, const msg::Ping& ping) {
      log();
      sidescan_->take(ping);
    });
    ports.in_topics<msg::BottomTrack>("bottom", all,
                                      [this](const std::string&, const msg::BottomTrack& bottom) {
                                        log();
                                        sidescan_->take(bottom);
                                      },
                                      {.optional = true});
  }
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { log().take(estimate); });
  ports.in<msg::Attitude>("attitude", [this](const msg::Attitude& attitude) { log().take(attitude); });
  ports.in<msg::Position>("position", [this](const msg::Position& position) { log().take(position); });
  if (config.rotate_lines) {
    ports.in<msg::MissionState>("mission", [this](const msg::MissionState& state) { log().take(state); });
  }
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

logger::SurveyLog& LoggerNode::log() {
  if (log_) return *log_;
  check_head();
  const auto multibeam = declared_head(ports_, config_.head), sidescan = declared_head(ports_, config_.sidescan);
  if (sidescan) sidescan_.emplace(*sidescan);
  std::vector<std::unique_ptr<logger::Format>> formats;
  if (multibeam) logger::check_instrument(ports_.process(), config_.formats, config_.head, *multibeam);
  const std::string mark = logger::simulated_by(multibeam ? multibeam->instrument : std::string());
  for (const std::string& format : config_.formats) {
    const logger::Part part = format.ends_with("wcd") ? logger::Part::kWaterColumn : logger::Part::kSoundings;
    if (format == "xtf") formats.push_back(std::make_unique<logger::XtfFormat>(config_, mark, sidescan, multibeam));
    else if (format.starts_with("km")) formats.push_back(std::make_unique<logger::KmallFormat>(config_, mark, part));
    else formats.push_back(std::make_unique<logger::AllFormat>(config_, mark, part));
  }
  logger::Files* files = &files_;
  if (!config_.send.empty()) {
    try {
      files = &sent_.emplace(config_, files_);
    } catch (const UserError& error) {
      throw UserError(fmt::format("{}: {}", ports_.process(), error.what()));
    }
  }
  return log_.emplace(config_, std::move(formats), *files);
}

/// Of all receivers together. Only where something is lost, refused or late do counts follow from wall time.
void LoggerNode::count_sent() {
  std::map<std::string, std::int64_t> now;
  for (const logger::SentFiles::Counts& one : sent_->counts()) {
    now["stream_datagrams"] += one.datagrams;
    now["stream_bytes"] += one.bytes;
    now["stream_lost"] += one.sent.lost;
    now["stream_refused"] += one.sent.refused;
    now["stream_late"] += one.sent.late;
  }
  for (const auto& [what, count] : now) {
    if (count > sent_counts_[what]) ports_.count(what, count - sent_counts_[what]);
  }
  sent_counts_ = std::move(now);
}

SimTime LoggerNode::step(SimTime now) {
  due_.due(now);
  logger::SurveyLog& log = this->log();
  if (sidescan_) {
    for (logger::SidescanPing& ping : sidescan_->complete()) log.take(std::move(ping));
  }
  if (world_) log.write(*world_);
  if (log.pings_left_out() > counted_) ports_.count("pings_left_out", log.pings_left_out() - counted_);
  counted_ = log.pings_left_out();
  if (sent_) count_sent();
  return due_.next();
}

void LoggerNode::finish_run() {
  if (world_ && log_) log_->close(*world_);
  if (!sent_) return;
  sent_->finish();
  for (const logger::SentFiles::Counts& one : sent_->counts()) {
    log::event(ports_, "streamed", "to={} datagrams={} bytes={} lost={} refused={} late={} latest_s={:.3f}", one.to,
               one.sent.datagrams, one.sent.bytes, one.sent.lost, one.sent.refused, one.sent.late, one.sent.latest_s);
  }
}

}  // namespace ensonify
