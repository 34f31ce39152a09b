#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/formats/all/reader.h"
#include "components/formats/kmall/reader.h"
#include "components/runtime/tool.h"
#include "tools/grid/input.h"

namespace ensonify::grid_tool {
namespace {

namespace all = formats::all;
namespace kmall = formats::kmall;
using frames::Geodetic;
using frames::Vec2;

// What a file does not state of its depths: draught, tide and heave alike everywhere, sound speed with the depth; one
// standard deviation. docs/manual/grid.md says so.
constexpr double kFixed_m = 0.08;
constexpr double kOfDepth = 0.002;

constexpr std::int64_t kLongestGap_ns = 5'000'000'000;  // between fixes, and between a fix and a ping outside them
const Vec2 kNowhere(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());

double sd_m(double detection_m, double depth_m) {
  return std::hypot(std::isfinite(detection_m) ? detection_m : 0.0, kFixed_m, kOfDepth * depth_m);
}

/// What both formats share: depths from the water line, or reduced by a tide.
class KongsbergFile : public SoundingFile {
 public:
  const FileFacts& facts() const override { return facts_; }

 protected:
  KongsbergFile(const std::string& file, const ReadOptions& options) : file_(file), tide_(options.tide) {
    facts_.file = file;
    facts_.datum = tide_ ? "chart datum, by the tide of " + std::filesystem::path(tide_->file()).filename().string()
                         : "water line";
    if (!options.topics.empty()) throw UserError("--soundings: " + file + " has no topics; it is for records (.mcap)");
  }

  /// Throws unless the file has said where it is.
  void set_origin(const std::optional<Geodetic>& origin, const char* missing) {
    if (!origin) throw UserError(file_ + ": holds no " + missing);
    facts_.origin = origin;
    projection_.emplace(*origin);
  }
  double tide_m(std::int64_t unix_ns) const { return tide_ ? tide_->level_m(unix_ns) : 0.0; }
  void note(const formats::Faults& faults) const {
    if (faults.count() > 0)
      fmt::print(stderr, "ensonify grid: {}: {} faults, which were passed over; ensonify info lists them\n", file_,
                 faults.count());
  }

  std::string file_;
  std::optional<formats::Tide> tide_;
  FileFacts facts_;
  std::optional<frames::LocalProjection> projection_;
};

bool known(double latitude_deg, double longitude_deg) {
  const bool in_range = std::abs(latitude_deg) < 90.0 && std::abs(longitude_deg) <= 180.0;
  return in_range && !(latitude_deg == 0.0 && longitude_deg == 0.0);
}

/// XYZ 88: positions of soundings by the vessel's own, by its active system, between fixes.
class AllFile : public KongsbergFile {
 public:
  AllFile(const std::string& file, const ReadOptions& options) : KongsbergFile(file, options) {
    std::vector<Fix> passive;
    bool soundings = false;
    each([&](const all::Datagram& datagram) {
      soundings = soundings || std::holds_alternative<all::Soundings>(datagram.body);
      const auto* position = std::get_if<all::Position>(&datagram.body);
      if (position == nullptr) return;
      const double latitude_deg = position->latitude_deg.value(), longitude_deg = position->longitude_deg.value();
      if (!known(latitude_deg, longitude_deg)) return;
      const bool active = (position->descriptor & 0x80) != 0;
      (active ? fixes_ : passive).push_back({datagram.unix_ns(), {latitude_deg, longitude_deg}, {}});
    });
    if (fixes_.empty()) fixes_ = std::move(passive);
    if (!soundings) throw UserError(file + ": holds no soundings (XYZ 88)");
    set_origin(fixes_.empty() ? std::nullopt : std::optional(fixes_.front().at), "position");
    std::stable_sort(fixes_.begin(), fixes_.end(), [](const Fix& a, const Fix& b) { return a.unix_ns < b.unix_ns; });
    for (Fix& fix : fixes_) fix.enu_m = projection_->enu_of(fix.at);
  }

  void read(const TakeSounding& take) override {
    const formats::Faults faults = each([&](const all::Datagram& datagram) {
      if (const auto* soundings = std::get_if<all::Soundings>(&datagram.body))
        give(*soundings, datagram.unix_ns(), take);
    });
    note(faults);
  }

 private:
  struct Fix {
    std::int64_t unix_ns;
    Geodetic at;
    Vec2 enu_m;
  };

  template <class See>
  formats::Faults each(const See& see) {
    formats::Window window(file_);
    all::Reader reader(window);
    while (const auto datagram = interrupted() ? std::nullopt : reader.next()) see(*datagram);
    return reader.faults();
  }

  /// Straight between fixes; the nearest one before the first and after the last. Nowhere, as NaN, far from any.
  Vec2 at(std::int64_t unix_ns) const {
    const auto after = std::lower_bound(fixes_.begin(), fixes_.end(), unix_ns,
                                        [](const Fix& fix, std::int64_t t) { return fix.unix_ns < t; });
    const auto near = [&](const Fix& fix) {
      return std::abs(fix.unix_ns - unix_ns) <= kLongestGap_ns ? fix.enu_m : kNowhere;
    };
    if (after == fixes_.begin()) return near(*after);
    if (after == fixes_.end()) return near(fixes_.back());
    const Fix& before = *(after - 1);
    if (after->unix_ns - before.unix_ns > kLongestGap_ns) return kNowhere;
    const double part =
        static_cast<double>(unix_ns - before.unix_ns) / static_cast<double>(after->unix_ns - before.unix_ns);
    return before.enu_m + part * (after->enu_m - before.enu_m);
  }

  void give(const all::Soundings& soundings, std::int64_t unix_ns, const TakeSounding& take) const {
    const Vec2 vessel = at(unix_ns);
    const double true_rad = soundings.heading_deg.value() * M_PI / 180.0;
    const double heading_rad = true_rad - projection_->convergence_rad(vessel);
    const Vec2 forward(std::sin(heading_rad), std::cos(heading_rad)), starboard(forward.y(), -forward.x());
    const double tide = tide_m(unix_ns);
    for (const all::Soundings::Beam& beam : soundings.beams) {
      if (!beam.valid()) continue;
      const double x_m = beam.x_m, y_m = beam.y_m, z_m = beam.z_m;
      const Vec2 position = vessel + x_m * forward + y_m * starboard;
      const double depth_m = z_m + static_cast<double>(soundings.transducer_depth_m) - tide;
      const double range_sd_m = beam.quality / 2500.0 * std::hypot(x_m, y_m, z_m);
      take({position.x(), position.y(), depth_m, sd_m(range_sd_m, depth_m)});
    }
  }

  std::vector<Fix> fixes_;  // of the active system, in order of time
};

/// #MRZ: each sounding has its own latitude and longitude.
class KmallFile : public KongsbergFile {
 public:
  KmallFile(const std::string& file, const ReadOptions& options) : KongsbergFile(file, options) {
    std::optional<Geodetic> origin;
    bool soundings = false;
    formats::Window window(file_);
    kmall::Reader reader(window);
    while (!origin) {
      const auto datagram = reader.next();
      if (!datagram) break;
      const auto* ping = std::get_if<kmall::Soundings>(&datagram->body);
      if (ping == nullptr) continue;
      soundings = true;
      if (known(ping->pose.latitude_deg, ping->pose.longitude_deg))
        origin = Geodetic{ping->pose.latitude_deg, ping->pose.longitude_deg};
    }
    if (!soundings) throw UserError(file + ": holds no soundings (#MRZ)");
    set_origin(origin, "ping with a position");
  }

  void read(const TakeSounding& take) override {
    formats::Window window(file_);
    kmall::Reader reader(window);
    while (const auto datagram = interrupted() ? std::nullopt : reader.next()) {
      if (const auto* ping = std::get_if<kmall::Soundings>(&datagram->body)) give(*ping, datagram->unix_ns(), take);
    }
    note(reader.faults());
  }

 private:
  void give(const kmall::Soundings& ping, std::int64_t unix_ns, const TakeSounding& take) const {
    const bool somewhere = known(ping.pose.latitude_deg, ping.pose.longitude_deg);
    const double tide = tide_m(unix_ns);
    for (const kmall::Sounding& sounding : ping.soundings) {
      if (sounding.detection != 0) continue;  // an extra one is of the water column
      const double latitude_deg = ping.pose.latitude_deg + static_cast<double>(sounding.delta_latitude_deg);
      const double longitude_deg = ping.pose.longitude_deg + static_cast<double>(sounding.delta_longitude_deg);
      const Vec2 position = somewhere ? projection_->enu_of({latitude_deg, longitude_deg}) : kNowhere;
      const double depth_m = static_cast<double>(sounding.z_m) - static_cast<double>(ping.pose.water_line_m) - tide;
      take({position.x(), position.y(), depth_m, sd_m(static_cast<double>(sounding.vertical_sd_m), depth_m)});
    }
  }
};

}  // namespace

std::unique_ptr<SoundingFile> open_all(const std::string& file, const ReadOptions& options) {
  return std::make_unique<AllFile>(file, options);
}

std::unique_ptr<SoundingFile> open_kmall(const std::string& file, const ReadOptions& options) {
  return std::make_unique<KmallFile>(file, options);
}

}  // namespace ensonify::grid_tool
