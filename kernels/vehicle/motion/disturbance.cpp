#include "kernels/vehicle/motion/disturbance.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::motion {
namespace {

constexpr std::size_t kBands = 256;
constexpr double kLowest_hz = 1.0 / 500.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// What a random number is for; the second counter of every draw.
enum Draw : std::uint64_t { kFrequency = 0, kCommonPhase = 1, kOwnPhase = 16, kWanderPhase = 32 };

void check(const AxisDisturbance& axis, const std::string& name) {
  const auto must = [&name](bool good, const char* what) {
    if (!good) throw std::invalid_argument("disturbance of " + name + ": " + what);
  };
  must(axis.oscillation_sd >= 0.0 && std::isfinite(axis.oscillation_sd), "oscillation_sd must be 0 or more");
  must(axis.wander_sd >= 0.0 && std::isfinite(axis.wander_sd), "wander_sd must be 0 or more");
  must(axis.period_s > 0.0 && axis.period_s <= 200.0, "period_s must be above 0 and at most 200");
  must(axis.return_s > 0.0 && axis.return_s <= 1e6, "return_s must be above 0 and at most 1e6");
  must(axis.jitter >= 0.02 && axis.jitter <= 0.5, "jitter must be 0.02 to 0.5");
  must(axis.coherence >= 0.0 && axis.coherence <= 1.0, "coherence must be 0 to 1");
  must(axis.hurst > 0.0 && axis.hurst < 1.0, "hurst must be between 0 and 1");
  must(std::isfinite(axis.lead_rad), "lead_rad must be a number");
}

struct Band {
  double low_hz, high_hz;
  double frequency_hz;  // of its wave
};

std::vector<Band> bands(double highest_hz, const random::Stream& stream) {
  const double ratio = std::pow(highest_hz / kLowest_hz, 1.0 / kBands);
  std::vector<Band> result(kBands);
  for (std::size_t k = 0; k < kBands; ++k) {
    const double low_hz = kLowest_hz * std::pow(ratio, static_cast<double>(k));
    result[k] = {low_hz, low_hz * ratio, low_hz * std::pow(ratio, stream.uniform(k, kFrequency))};
  }
  return result;
}

/// Amplitudes of the waves whose variances are in proportion to `power` and sum up to sd^2.
template <class Power>
std::vector<double> amplitudes(const std::vector<Band>& bands, double sd, Power power) {
  std::vector<double> result(bands.size(), 0.0);
  if (sd == 0.0) return result;
  double sum = 0.0;
  for (std::size_t k = 0; k < bands.size(); ++k) sum += result[k] = power(bands[k]);
  for (double& amplitude : result) amplitude = sd * std::sqrt(2.0 * amplitude / sum);
  return result;
}

std::vector<double> oscillation(const std::vector<Band>& bands, const AxisDisturbance& axis) {
  const double scale = axis.period_s / (std::numbers::sqrt2 * axis.jitter);
  const auto below = [&](double f_hz) { return std::erf((f_hz - 1.0 / axis.period_s) * scale); };
  return amplitudes(bands, axis.oscillation_sd,
                    [&](const Band& band) { return below(band.high_hz) - below(band.low_hz); });
}

std::vector<double> wander(const std::vector<Band>& bands, const AxisDisturbance& axis) {
  const double corner_hz = 1.0 / (kTwoPi * axis.return_s);
  return amplitudes(bands, axis.wander_sd, [&](const Band& band) {
    const double f = band.frequency_hz;
    return std::pow(f * f + corner_hz * corner_hz, -(axis.hurst + 0.5)) * (band.high_hz - band.low_hz);
  });
}

constexpr double kDegree = std::numbers::pi / 180.0;

DisturbanceParameters research_ship() {
  DisturbanceParameters p;
  p.heave = {.oscillation_sd = 1.12, .period_s = 10.7, .jitter = 0.24, .coherence = 1.0};
  p.roll = {.oscillation_sd = 0.58 * kDegree, .period_s = 12.8, .jitter = 0.2, .coherence = 0.54};
  p.pitch = {.oscillation_sd = 1.86 * kDegree,
             .period_s = 9.1,
             .jitter = 0.25,
             .coherence = 0.87,
             .lead_rad = 0.5 * std::numbers::pi};
  p.heading = {.oscillation_sd = 0.5 * kDegree, .period_s = 11.3, .wander_sd = 0.43 * kDegree, .hurst = 0.7};
  return p;
}

DisturbanceParameters survey_launch() {
  DisturbanceParameters p;
  p.heave = {.oscillation_sd = 0.03, .period_s = 3.5, .coherence = 1.0};
  p.roll = {.oscillation_sd = 1.65 * kDegree, .period_s = 4.0, .coherence = 0.5, .wander_sd = 0.41 * kDegree};
  p.pitch = {.oscillation_sd = 0.79 * kDegree, .period_s = 3.0, .coherence = 0.8, .wander_sd = 0.13 * kDegree};
  p.heading = {.oscillation_sd = 0.5 * kDegree, .period_s = 5.0, .wander_sd = 1.0 * kDegree, .hurst = 0.6};
  return p;
}

DisturbanceParameters auv() {
  DisturbanceParameters p;
  p.heave = {.wander_sd = 0.03, .hurst = 0.6, .return_s = 20};
  p.sway = {.wander_sd = 0.05, .hurst = 0.6, .return_s = 20};
  p.roll = {.oscillation_sd = 0.8 * kDegree, .period_s = 3.0, .wander_sd = 0.5 * kDegree};
  p.pitch = {.oscillation_sd = 0.4 * kDegree, .period_s = 4.0, .wander_sd = 0.3 * kDegree};
  p.heading = {.wander_sd = 0.7 * kDegree, .hurst = 0.6};
  return p;
}

}  // namespace

Disturbance::Disturbance(const DisturbanceParameters& p, const random::Stream& stream) {
  const std::array<const AxisDisturbance*, kAxes> axes{&p.surge, &p.sway, &p.heave, &p.roll, &p.pitch, &p.heading};
  const char* names[] = {"surge", "sway", "heave", "roll", "pitch", "heading"};
  bool moves = false;
  for (std::size_t i = 0; i < kAxes; ++i) {
    check(*axes[i], names[i]);
    if (axes[i]->oscillation_sd > 0.0 && !(p.highest_hz * axes[i]->period_s > 1.0)) {
      throw std::invalid_argument(std::string("disturbance of ") + names[i] + ": 1 / period_s is above highest_hz");
    }
    moves = moves || axes[i]->oscillation_sd > 0.0 || axes[i]->wander_sd > 0.0;
  }
  if (!(p.highest_hz > 2.0 * kLowest_hz && p.highest_hz <= 50.0)) {
    throw std::invalid_argument("disturbance: highest_hz must be 0.004 to 50");
  }
  if (!moves) return;

  const std::vector<Band> spectrum = bands(p.highest_hz, stream);
  waves_.resize(kBands);
  for (std::size_t k = 0; k < kBands; ++k) waves_[k].omega_radps = kTwoPi * spectrum[k].frequency_hz;
  for (std::size_t i = 0; i < kAxes; ++i) {
    const AxisDisturbance& axis = *axes[i];
    const std::vector<double> beats = oscillation(spectrum, axis), drifts = wander(spectrum, axis);
    for (std::size_t k = 0; k < kBands; ++k) {
      const auto phase = [&](std::uint64_t what) { return kTwoPi * stream.uniform(k, what); };
      const std::array<std::pair<double, double>, 3> parts{{
          {beats[k] * axis.coherence, phase(kCommonPhase) + axis.lead_rad},
          {beats[k] * std::sqrt(1.0 - axis.coherence * axis.coherence), phase(kOwnPhase + i)},
          {drifts[k], phase(kWanderPhase + i)},
      }};
      waves_[k].cosine[i] = waves_[k].sine[i] = 0.0;
      for (const auto& [amplitude, phase_rad] : parts) {  // amplitude cos(omega t + phase)
        waves_[k].cosine[i] += amplitude * std::cos(phase_rad);
        waves_[k].sine[i] -= amplitude * std::sin(phase_rad);
      }
    }
    // Parts of one band interfere; what that adds or takes is given back.
    double variance = 0.0;
    for (const Wave& wave : waves_) {
      variance += 0.5 * (wave.cosine[i] * wave.cosine[i] + wave.sine[i] * wave.sine[i]);
    }
    if (variance == 0.0) continue;
    const double scale = std::hypot(axis.oscillation_sd, axis.wander_sd) / std::sqrt(variance);
    for (Wave& wave : waves_) {
      wave.cosine[i] *= scale;
      wave.sine[i] *= scale;
    }
  }
}

Excursion Disturbance::at(double t_s) const {
  std::array<Moving, kAxes> sum{};
  for (const Wave& wave : waves_) {
    const double c = std::cos(wave.omega_radps * t_s), s = std::sin(wave.omega_radps * t_s);
    for (std::size_t i = 0; i < kAxes; ++i) {
      const double value = wave.cosine[i] * c + wave.sine[i] * s;
      sum[i].value += value;
      sum[i].rate += wave.omega_radps * (wave.sine[i] * c - wave.cosine[i] * s);
      sum[i].acceleration -= wave.omega_radps * wave.omega_radps * value;
    }
  }
  return {sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]};
}

std::optional<DisturbanceParameters> disturbance_preset(std::string_view name) {
  if (name == "research_ship") return research_ship();
  if (name == "survey_launch") return survey_launch();
  if (name == "auv") return auv();
  return std::nullopt;
}

}  // namespace ensonify::motion
