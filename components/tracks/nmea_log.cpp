#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "components/errors/overloaded.h"
#include "components/formats/nmea/navigation.h"
#include "components/formats/time_of_day.h"
#include "components/tracks/readers.h"
#include "scenarios/scenario_file.h"

namespace ensonify::tracks {
namespace {

constexpr std::int64_t kSpread_ns = 2'000'000'000;  // between two timed sentences, at most

/// Sentences that have a time count as of it, on across midnight. What has none counts by the stamps in front of the
/// lines, where they are: as much after the last timed sentence as its line came after that one's. Without stamps the
/// untimed sentences of a kind between two timed ones lie evenly between them.
class LogReader {
 public:
  explicit LogReader(const std::string& file) : file_(file) { track_.file = file; }

  Track read() {
    std::ifstream in(file_);
    std::string line;
    for (number_ = 1; std::getline(in, line); ++number_) {
      const std::size_t begin = line.find('$');
      if (begin == std::string::npos) continue;
      stamp_ns_ = stamp_of(line.substr(0, begin));
      std::visit([&](const auto& said) { use(said); }, nmea::read_navigation(std::string_view(line).substr(begin)));
    }
    spread(std::nullopt);
    track_.fixes = gga_.empty() ? std::move(rmc_) : std::move(gga_);
    track_.heading_rad = gyro_.empty() ? std::move(of_motion_) : std::move(gyro_);
    if (track_.fixes.empty())
      throw UserError(
          fmt::format("{}: holds no fix; allowed: a log with GGA or RMC, of quality above 0 and with a "
                      "checksum ({} lines have a wrong one)",
                      file_, bad_checksums_));
    return std::move(track_);
  }

 private:
  /// What a sentence without a time waits with, until the next time has come.
  enum class Kind { kHeading, kMotion };

  std::string here(const char* what) const { return fmt::format("{}:{}: {}", file_, number_, what); }

  static std::optional<std::int64_t> stamp_of(std::string text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == ',')) text.pop_back();
    return parse_utc_ns(text);
  }

  std::int64_t timed_ns(double time_of_day_s) {
    if (!day_s_) {
      day_s_ = time_of_day_s;
      last_stamp_ns_ = stamp_ns_;
      return last_ns_;
    }
    const double step_s = formats::time_of_day_step_s(*day_s_, time_of_day_s);
    const std::int64_t ns = last_ns_ + std::llround(1e9 * step_s);
    if (step_s > 0.0) {
      spread(ns);
      day_s_ = time_of_day_s;
      last_ns_ = ns;
      last_stamp_ns_ = stamp_ns_;
    }
    return ns;
  }

  void use(const nmea::Fix& fix) { use_fix(fix, gga_); }
  void use(const nmea::MinimumFix& minimum) { use_fix(minimum.fix, rmc_); }
  void use_fix(const nmea::Fix& fix, std::vector<Fix>& to) {
    if (fix.quality == 0) return;
    append(to, {timed_ns(fix.time_s), {fix.latitude_deg, fix.longitude_deg}}, here("a fix's"));
  }

  void use(const nmea::Datum& datum) {
    if (datum.code != "W84") throw UserError(here("fixes are on datum ") + datum.code + "; allowed: W84");
  }
  void use(const nmea::MotionQuality& quality) { quality_ = quality; }

  void use(const nmea::Heading& heading) {
    formats::Motion motion;
    motion.true_heading_rad = heading.true_heading_rad;
    without_time(Kind::kHeading, motion);
  }
  void use(const formats::Motion& motion) {
    if (motion.time_s) return take(Kind::kMotion, timed_ns(*motion.time_s), motion, number_);
    formats::Motion good = motion;
    if (!quality_.roll_and_pitch) good.roll_rad = good.pitch_rad = std::nullopt;
    if (!quality_.heave) good.heave_m = std::nullopt;
    if (!quality_.heading) good.true_heading_rad = std::nullopt;
    without_time(Kind::kMotion, good);
  }
  void use(const nmea::BadChecksum&) { ++bad_checksums_; }
  void use(const auto&) {}

  void without_time(Kind kind, const formats::Motion& motion) {
    if (!day_s_) return;  // nothing gives its time
    if (stamp_ns_ && last_stamp_ns_) return take(kind, last_ns_ + *stamp_ns_ - *last_stamp_ns_, motion, number_);
    waiting_[kind].emplace_back(motion, number_);
  }

  void spread(std::optional<std::int64_t> next_ns) {
    for (auto& [kind, motions] : waiting_) {
      const bool even = next_ns && *next_ns - last_ns_ <= kSpread_ns;
      const auto count = static_cast<std::int64_t>(motions.size());
      for (std::int64_t i = 0; i < (even ? count : std::min<std::int64_t>(count, 1)); ++i) {
        const auto& [motion, number] = motions[static_cast<std::size_t>(i)];
        take(kind, last_ns_ + (even ? i * (*next_ns - last_ns_) / count : 0), motion, number);
      }
      motions.clear();
    }
  }

  void take(Kind kind, std::int64_t ns, const formats::Motion& motion, int number) {
    const std::string where = fmt::format("{}:{}: a motion's", file_, number);
    const auto push = [&](std::vector<Value>& to, const std::optional<double>& value) {
      if (value) append(to, {ns, *value}, where);
    };
    push(kind == Kind::kHeading ? gyro_ : of_motion_, motion.true_heading_rad);
    push(track_.roll_rad, motion.roll_rad);
    push(track_.pitch_rad, motion.pitch_rad);
    push(track_.heave_m, motion.heave_m);
  }

  const std::string& file_;
  int number_ = 0;
  Track track_;
  std::vector<Fix> gga_, rmc_;
  std::vector<Value> gyro_, of_motion_;  // headings
  nmea::MotionQuality quality_;
  std::optional<double> day_s_;  // time of day of the newest time
  std::int64_t last_ns_ = 0;     // the same, counted from the first one
  std::optional<std::int64_t> stamp_ns_, last_stamp_ns_;
  std::map<Kind, std::vector<std::pair<formats::Motion, int>>> waiting_;
  int bad_checksums_ = 0;
};

}  // namespace

Track read_nmea_log(const std::string& file) { return LogReader(file).read(); }

}  // namespace ensonify::tracks
