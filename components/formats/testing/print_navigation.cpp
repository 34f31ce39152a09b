// Prints what is read of each line of standard input, one line each, for comparison with another reader: the kind and
// its values in the sentence's own units; "-" for what is not given. Of other lines nothing.   print_navigation < LOG
#include <cstdio>
#include <iostream>
#include <numbers>
#include <string>

#include "components/formats/nmea/navigation.h"

namespace {

using namespace ensonify::nmea;

constexpr double kDegree = std::numbers::pi / 180.0, kKnot_mps = 1852.0 / 3600.0;

void print(const char* kind, std::initializer_list<std::optional<double>> values) {
  std::fputs(kind, stdout);
  for (const auto& value : values) value ? std::printf(" %.9f", *value) : std::printf(" -");
  std::putchar('\n');
}

std::optional<double> in(double unit, const std::optional<double>& value) {
  return value ? std::optional(*value / unit) : std::nullopt;
}
double days(std::chrono::sys_days date) { return static_cast<double>(date.time_since_epoch().count()); }

struct Print {
  void operator()(const Fix& f) const {
    if (f.quality == 0) return print("GGA", {0});
    print("GGA",
          {f.quality, f.time_s, f.latitude_deg, f.longitude_deg, f.height_above_geoid_m, f.geoid_above_ellipsoid_m});
  }
  void operator()(const MinimumFix& m) const {
    if (m.fix.quality == 0) return print("RMC", {0});
    print("RMC", {m.fix.time_s, m.fix.latitude_deg, m.fix.longitude_deg, in(kKnot_mps, m.course->speed_mps),
                  in(kDegree, m.course->true_course_rad), days(*m.date)});
  }
  void operator()(const Course& c) const { print("VTG", {in(kDegree, c.true_course_rad), in(kKnot_mps, c.speed_mps)}); }
  void operator()(const Heading& h) const { print("HDT", {in(kDegree, h.true_heading_rad)}); }
  void operator()(const TurnRate& r) const { print("ROT", {in(kDegree / 60.0, r.rate_radps)}); }
  void operator()(const DateAndTime& d) const { print("ZDA", {d.time_s, days(d.date)}); }
  void operator()(const FixAccuracy& a) const { print("GST", {a.time_s, a.latitude_m, a.longitude_m, a.height_m}); }
  void operator()(const WaterDepth& d) const { print("DPT", {d.below_transducer_m, d.offset_m}); }
  void operator()(const TwoSpeeds& s) const {
    print("VBW", {in(kKnot_mps, s.water_ahead_mps), in(kKnot_mps, s.water_starboard_mps),
                  in(kKnot_mps, s.ground_ahead_mps), in(kKnot_mps, s.ground_starboard_mps)});
  }
  void operator()(const Datum& d) const { std::printf("DTM %s\n", d.code.c_str()); }
  void operator()(const Motion& m) const {
    print("motion",
          {m.time_s, in(kDegree, m.true_heading_rad), in(kDegree, m.roll_rad), in(kDegree, m.pitch_rad), m.heave_m});
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) std::visit(Print{}, read_navigation(line));
}
