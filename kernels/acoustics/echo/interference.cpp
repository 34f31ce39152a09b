#include "kernels/acoustics/echo/interference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::echo {
namespace {

constexpr double kNearest_m = 0.1;  // spreading begins there
constexpr double kGoldenRatio = 0.6180339887498949;

std::complex<double> turned(double amplitude, double cycles) {
  return std::polar(amplitude, 2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
}

/// How many echoes of ours, one after another, last as long as what passes.
long pulses_in(const Passed& passed, double length_s) {
  return std::max(1L, std::lround(passed.duration_s / length_s));
}

/// Times within a sweep at which it passes a frequency; a tone (0 Hz) has all of its frequencies from its start on.
double passes_at_s(double sweep_hz, double length_s, double offset_hz) {
  return sweep_hz > 0.0 ? length_s * (offset_hz / sweep_hz + 0.5) : 0.0;
}

}  // namespace

Passed through_filter(const InterferingTransmission& interfering, const ReceiverBand& band, const Pulse& pulse) {
  const double theirs_hz = interfering.sweep_hz > 0.0 ? interfering.sweep_hz : 1.0 / interfering.duration_s;
  const double ours_hz = pulse.bandwidth_hz;
  const double apart_hz = interfering.frequency_hz - band.frequency_hz;
  const double low_hz = std::max(apart_hz - 0.5 * theirs_hz, -0.5 * ours_hz);
  const double high_hz = std::min(apart_hz + 0.5 * theirs_hz, 0.5 * ours_hz);
  const double least = pulse.equivalent_length_s();
  if (high_hz <= low_hz) {
    return {0.0, std::max(least, interfering.duration_s), std::pow(10.0, -0.1 * interfering.rejection_db)};
  }
  const double filter_sweep_hz = pulse.processing_gain_db > 0.0 ? ours_hz : 0.0;
  const auto out_s = [&](double offset_hz) {
    return passes_at_s(interfering.sweep_hz, interfering.duration_s, offset_hz - apart_hz) -
           passes_at_s(filter_sweep_hz, pulse.duration_s, offset_hz);
  };
  const double first_s = std::min(out_s(low_hz), out_s(high_hz)), last_s = std::max(out_s(low_hz), out_s(high_hz));
  const double each_s = interfering.sweep_hz > 0.0 ? 0.0 : interfering.duration_s;  // how long one frequency lasts
  const double duration_s = std::max(least, last_s - first_s + each_s);
  const double energy_s = interfering.duration_s * (high_hz - low_hz) / theirs_hz *
                          std::min(1.0, pulse.noise_bandwidth_hz / pulse.bandwidth_hz);
  return {first_s, duration_s, std::min(1.0, energy_s / duration_s)};
}

void add_echoes_of(const InterferingTransmission& other, const Arrivals& echoes, const ReceiverBand& band,
                   const Pulse& pulse, Arrivals& arrivals) {
  const Passed passed = through_filter(other, band, pulse);
  const double length_s = pulse.equivalent_length_s();
  const auto places = pulses_in(passed, length_s);
  const double mean_square = passed.power * static_cast<double>(places);
  const auto scale = static_cast<float>(other.frequency_hz / band.frequency_hz);
  double place = 0.0;  // 0..1, evenly, never twice the same
  for (const Arrival echo : echoes) {
    const double after_s = std::floor(place * static_cast<double>(places)) * length_s;
    place += kGoldenRatio - std::floor(place + kGoldenRatio);
    const double time_s = other.time_s + echo.time_s + passed.start_s + after_s;
    // Its phase is that at its own carrier, which began with its own transmission.
    const double cycles = (other.frequency_hz - band.frequency_hz) * time_s - other.frequency_hz * other.time_s;
    const auto pressure = band.sum == Sum::kPressure ? turned(std::sqrt(mean_square), cycles) : mean_square;
    arrivals.push_back(
        {time_s, echo.pressure_upa * std::complex<float>(pressure), scale * echo.direction_head, echo.contributor});
  }
}

void add_interference(std::span<const InterferingTransmission> transmissions, const ReceiverBand& band,
                      const Pulse& pulse, const Receivers& receivers, Arrivals& arrivals) {
  const double length_s = pulse.equivalent_length_s();
  for (const InterferingTransmission& interfering : transmissions) {
    const Passed passed = through_filter(interfering, band, pulse);
    const double path_m = std::max(kNearest_m, interfering.source_enu_m.norm());
    const double level_db = interfering.source_level_db - 20.0 * std::log10(path_m) - band.absorption_dbpm * path_m;
    const double mean_square = std::pow(10.0, 0.1 * level_db) * passed.power;
    const double arrival_s = interfering.time_s + path_m / band.sound_speed_mps;
    const Eigen::Vector3f direction =
        receivers.at(arrival_s).head_from_enu * (interfering.source_enu_m / path_m).cast<float>();
    const long pulses = pulses_in(passed, length_s);
    for (long i = 0; i < pulses; ++i) {
      const double time_s = arrival_s + passed.start_s + static_cast<double>(i) * length_s;
      // Our mixer turns it at the difference of frequencies; it left at phase 0 of its own.
      const double cycles =
          (interfering.frequency_hz - band.frequency_hz) * time_s - interfering.frequency_hz * arrival_s;
      const auto pressure = band.sum == Sum::kPressure ? turned(std::sqrt(mean_square), cycles) : mean_square;
      arrivals.push_back({time_s, std::complex<float>(pressure), direction});
    }
  }
}

}  // namespace ensonify::echo
