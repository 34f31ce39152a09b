#include "kernels/vehicle/vertical/tide.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "kernels/vehicle/motion/excursion.h"

namespace ensonify::vertical {
namespace {

struct Speed {
  std::string_view name;
  double degph;
};

// The independent and related constituents of the National Tidal and Sea Level Facility's list [NTSLF]; M6, S4, S6, K2
// and the long-period ones Mf, Ssa and Sa as NOAA states them.
constexpr Speed kSpeeds[] = {
    {"2N2", 27.8953548}, {"2SM2", 31.0158958}, {"J1", 15.5854433},  {"K1", 15.0410686},  {"K2", 30.0821373},
    {"L2", 29.5284789},  {"M2", 28.9841042},   {"M3", 43.4761563},  {"M4", 57.9682084},  {"M6", 86.9523127},
    {"MK3", 44.0251729}, {"MM", 0.5443747},    {"MN4", 57.4238337}, {"MO3", 42.9271398}, {"MS4", 58.9841042},
    {"MSF", 1.0158958},  {"MU2", 27.9682084},  {"N2", 28.4397295},  {"NU2", 28.5125831}, {"O1", 13.9430356},
    {"OO1", 16.1391017}, {"P1", 14.9589314},   {"Q1", 13.3986609},  {"S1", 15.0},        {"S2", 30.0},
    {"S4", 60.0},        {"S6", 90.0},         {"SSA", 0.0821373},  {"T2", 29.9589333},
};

Level harmonic(const HarmonicTide& tide, double t_s) {
  Level level{tide.mean_m};
  for (const Constituent& c : tide.constituents) {
    const double phase_rad = c.speed_radps * t_s - c.phase_rad;
    const double off_m = c.amplitude_m * std::cos(phase_rad);
    level.height_m += off_m;
    level.rate_mps -= c.amplitude_m * c.speed_radps * std::sin(phase_rad);
    level.acceleration_mps2 -= c.speed_radps * c.speed_radps * off_m;
  }
  return level;
}

}  // namespace

std::optional<double> constituent_speed_degph(std::string_view name) {
  for (const Speed& speed : kSpeeds) {
    if (speed.name == name) return speed.degph;
  }
  return std::nullopt;
}

std::string_view constituent_names() {
  return "2N2, 2SM2, J1, K1, K2, L2, M2, M3, M4, M6, MK3, MM, MN4, MO3, MS4, MSF, MU2, N2, NU2, O1, OO1, P1, Q1, S1, "
         "S2, "
         "S4, S6, SSA, T2";
}

Tide::Tide(GaugeReadings readings) {
  const auto& r = readings.time_s_and_height_m;
  if (r.empty()) throw std::invalid_argument("tide: no readings");
  Gauge gauge;
  for (const auto& [t_s, height_m] : r) {
    if (!gauge.level.push(t_s, height_m)) throw std::invalid_argument("tide: times of readings must rise");
  }
  if (r.size() > 1) gauge.to_rest_s = r.back().first - r[r.size() - 2].first;
  kind_ = std::move(gauge);
}

Level Tide::at(double t_s) const {
  if (const auto* constant = std::get_if<double>(&kind_)) return {*constant};
  if (const auto* constituents = std::get_if<HarmonicTide>(&kind_)) return harmonic(*constituents, t_s);
  const auto& [curve, to_rest_s] = std::get<Gauge>(kind_);
  if (t_s < curve.oldest_s()) return {curve.at(curve.oldest_s()).value};
  motion::Moving level = curve.at(t_s);
  if (const double behind_s = t_s - curve.newest_s(); behind_s > 0.0) {
    const double last_m = curve.newest();
    level = behind_s < to_rest_s ? motion::cubic_between({last_m, level.rate}, {last_m}, to_rest_s, behind_s)
                                 : motion::Moving{last_m};
  }
  return {level.value, level.rate, level.acceleration};
}

double Tide::first_s() const {
  const auto* gauge = std::get_if<Gauge>(&kind_);
  return gauge != nullptr ? gauge->level.oldest_s() : -std::numeric_limits<double>::infinity();
}

double Tide::last_s() const {
  const auto* gauge = std::get_if<Gauge>(&kind_);
  return gauge != nullptr ? gauge->level.newest_s() : std::numeric_limits<double>::infinity();
}

}  // namespace ensonify::vertical
