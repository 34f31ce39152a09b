#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "components/formats/em_attitude/em_attitude.h"
#include "components/formats/km_binary/km_binary.h"
#include "components/formats/nmea/navigation.h"
#include "components/formats/tss1/tss1.h"
#include "kernels/base/frames/local_projection.h"

/// What comes of a navigation feed, and what it says of itself.
namespace ensonify::feed_doctor {

/// All that is known of sentences or frames of one kind.
struct Kind {
  std::size_t count = 0;
  std::vector<double> arrivals_s;  // where they are known
  std::vector<double> own_s;       // of the UTC day, where they have a time
  std::vector<double> ahead_s;     // own time less the clock's at arrival
  std::size_t repeats = 0;         // of headings and motion: the same values as before
  std::string newest;              // those values, as text
};

/// Values by time, for what physics says of them. Times are seconds of any clock; they rise.
struct Sampled {
  double t_s = 0.0;
  double value = 0.0;
};
struct Placed {
  double t_s = 0.0;
  frames::Geodetic place;
  std::optional<double> height_m;
  int quality = 0;
};

struct Findings {
  enum class Format { kNone, kNmea, kTss1, kEmAttitude, kKmBinary };

  Format format = Format::kNone;
  double seconds = 0.0;  // from the first arrival to the last; 0: unknown
  std::size_t bytes = 0;
  std::map<std::string, Kind> kinds;  // "INGGA", "PSXN,23", "tss1"
  std::set<std::string> talkers, datums;
  std::map<int, std::size_t> qualities;          // of fixes
  std::map<long, std::size_t> dates_ahead_days;  // of the clock's at arrival, and how many
  std::size_t bad_checksums = 0, malformed = 0, unusable = 0, skipped_bytes = 0;
  std::vector<Placed> fixes;
  std::vector<Sampled> heading_rad, roll_rad, pitch_rad, heave_m, acceleration_mps2;

  std::size_t sentences() const;
};

/// As nav_feed's sources have it; "" where none is known.
const char* word_of(Findings::Format format);

/// Takes what arrives, in any of the formats that nav_feed knows: which one it is, its frames say.
class Examiner {
 public:
  /// `unix_s`: the clock at arrival; nothing where it is not known, as in a log without stamps. `whole`: a datagram or
  /// a line, whose last sentence needs no line end.
  void take(std::string_view bytes, std::optional<double> unix_s, bool whole);
  Findings findings();

 private:
  void take_line(const std::string& line);
  void use_date(std::chrono::sys_days date, double time_s);
  void use(const nmea::Fix& fix, Kind& kind);
  void use(const formats::Motion& motion, Kind& kind);
  void frame(const char* name, const std::optional<formats::Motion>& motion);
  /// Notes a kind's arrival, and its own time.
  Kind& note(const std::string& name, std::optional<double> own_s);
  double time_s(std::optional<double> own_s);

  Findings found_;
  std::optional<double> unix_s_, first_s_, last_s_;
  std::string line_;
  formats::tss1::Stream tss1_;
  formats::em_attitude::Stream em_attitude_;
  formats::km_binary::Stream km_binary_;
  std::size_t tss1_frames_ = 0, em_frames_ = 0, km_frames_ = 0, sentences_ = 0;
  double own_s_ = 0.0;                   // the newest own time, on across midnight
  std::optional<double> own_at_unix_s_;  // when it came
  bool has_own_ = false;
};

}  // namespace ensonify::feed_doctor
