#include "kernels/acoustics/detect/testing/plane_echo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/base/random/stream.h"

namespace ensonify::detect {
namespace {

using Complex = std::complex<double>;

int samples_of(const PlaneSurvey& survey) { return static_cast<int>(survey.longest_s / survey.period_s); }

struct Scatterer {
  double two_way_s;
  Complex positive, negative;
};

/// Echoes in order of time, and the noise power that goes with them.
struct Echoes {
  std::vector<Scatterer> scatterers;
  double noise_power = 0.0;
};

/// What a plane sends into a beam: all of it together has this mean energy. `draws` distinguishes planes and beams.
void add_plane(const PlaneSurvey& survey, double energy, double sin_beam, const random::Stream& stream,
               std::uint64_t ping, std::uint64_t draws, std::vector<Scatterer>& scatterers) {
  const double reach = PlaneEcho::kReach / survey.length_in_waves;
  const double low = std::max(sin_beam - reach, -0.9999), high = std::min(sin_beam + reach, 0.9999);
  const double axis_s = two_way_s(survey, sin_beam);
  const double pulses = std::abs(two_way_s(survey, high) - two_way_s(survey, low)) / survey.pulse_length_s;
  const auto count = static_cast<std::size_t>(std::max(survey.scatterers_per_pulse * pulses, 300.0));

  const double half = 0.5 * survey.length_in_waves;
  // Mean power of a scatterer: all that the beam sees add up to the energy.
  const double power = energy * survey.length_in_waves * (high - low) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double sine = low + (high - low) * stream.uniform(ping, draws, 2 * i);
    const auto [re, im] = stream.normal_pair(ping, draws, 2 * i + 1);
    const double off_axis = sine - sin_beam, time = two_way_s(survey, sine);
    const Complex seen =
        Complex(re, im) * std::sqrt(0.5 * power) * (axis_s / time) * 0.5 * array::line_amplitude(half, off_axis);
    const Complex turn = std::polar(1.0, std::numbers::pi * half * off_axis);
    scatterers.push_back({time, seen * turn, seen * std::conj(turn)});
  }
}

Echoes echoes_of(const PlaneSurvey& survey, double sin_beam, const random::Stream& stream, std::uint64_t ping,
                 std::uint64_t beam) {
  Echoes echoes;
  add_plane(survey, 1.0, sin_beam, stream, ping, beam, echoes.scatterers);
  if (survey.second_db > -200.0) {
    PlaneSurvey second = survey;
    second.depth_m *= 2.0;
    add_plane(second, std::pow(10.0, 0.1 * survey.second_db), sin_beam, stream, ping, beam + (1ULL << 32),
              echoes.scatterers);
  }
  std::sort(echoes.scatterers.begin(), echoes.scatterers.end(),
            [](const Scatterer& a, const Scatterer& b) { return a.two_way_s < b.two_way_s; });
  // Mean power at the axis: what comes from there during a pulse, or all if the beam sees less than that.
  const double incidence = std::asin(sin_beam) - survey.tilt_rad;
  const double axis_s = two_way_s(survey, sin_beam);
  const double sines_per_s =
      std::sqrt(1.0 - sin_beam * sin_beam) / (axis_s * std::max(std::abs(std::tan(incidence)), 1e-9));
  const double in_pulse = survey.length_in_waves * survey.pulse_length_s * sines_per_s;
  echoes.noise_power = std::min(in_pulse, 1.0) * std::pow(10.0, -0.1 * survey.snr_db);
  return echoes;
}

/// Sample k is the sum of the echoes that began within a pulse before it.
void sample(const PlaneSurvey& survey, const std::vector<Scatterer>& scatterers,
            std::span<std::complex<float>> positive, std::span<std::complex<float>> negative) {
  std::vector<Complex> positive_sums{{}}, negative_sums{{}};
  for (const Scatterer& s : scatterers) {
    positive_sums.push_back(positive_sums.back() + s.positive);
    negative_sums.push_back(negative_sums.back() + s.negative);
  }
  std::size_t begun = 0, ended = 0;
  for (std::size_t k = 0; k < positive.size(); ++k) {
    const double t = static_cast<double>(k) * survey.period_s;
    while (begun < scatterers.size() && scatterers[begun].two_way_s <= t) ++begun;
    while (ended < scatterers.size() && scatterers[ended].two_way_s <= t - survey.pulse_length_s) ++ended;
    positive[k] = std::complex<float>(positive_sums[begun] - positive_sums[ended]);
    negative[k] = std::complex<float>(negative_sums[begun] - negative_sums[ended]);
  }
}

/// Adds noise that came through the filter that echoes came through.
void add_noise(const PlaneSurvey& survey, float sd, const random::Stream& stream, std::uint64_t ping,
               std::uint64_t draws_from, std::span<std::complex<float>> half) {
  const echo::SampledPulse pulse(echo::rectangular_pulse(survey.pulse_length_s), survey.period_s);
  const auto response = pulse.response();
  std::vector<std::complex<float>> draws(half.size() + response.size());
  random::add_gaussian(stream, ping, draws_from, sd, draws);
  for (std::size_t k = 0; k < half.size(); ++k) {
    for (std::size_t i = 0; i < response.size(); ++i) half[k] += response[i] * draws[k + response.size() - i];
  }
}

}  // namespace

void PlaneEcho::ping(const PlaneSurvey& survey, const random::Stream& stream, std::uint64_t number) {
  const auto samples = static_cast<std::size_t>(samples_of(survey));
  const std::size_t beams = survey.sin_beams.size();
  positive_upa.assign(beams * samples, {});
  negative_upa.assign(beams * samples, {});
  amplitude_upa.resize(beams * samples);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const auto positive = std::span(positive_upa).subspan(beam * samples, samples);
    const auto negative = std::span(negative_upa).subspan(beam * samples, samples);
    const Echoes echoes = echoes_of(survey, survey.sin_beams[beam], stream, number, beam);
    sample(survey, echoes.scatterers, positive, negative);
    const auto sd = static_cast<float>(std::sqrt(0.25 * echoes.noise_power));  // per half and component
    add_noise(survey, sd, stream, number, (2 * beam + 1) << 40, positive);
    add_noise(survey, sd, stream, number, (2 * beam + 2) << 40, negative);
  }
  for (std::size_t i = 0; i < amplitude_upa.size(); ++i) amplitude_upa[i] = std::abs(positive_upa[i] + negative_upa[i]);
}

Amplitudes PlaneEcho::amplitudes(const PlaneSurvey& survey) const {
  return {static_cast<int>(survey.sin_beams.size()), samples_of(survey), 0.0, survey.period_s, amplitude_upa};
}

Settings settings_for(const PlaneSurvey& survey) {
  Settings settings;
  settings.pulse_length_s = survey.pulse_length_s;
  settings.sound_speed_mps = survey.sound_speed_mps;
  settings.receive_length_in_waves = survey.length_in_waves;
  settings.phase_centres_in_waves = 0.5 * survey.length_in_waves;
  return settings;
}

double two_way_s(const PlaneSurvey& survey, double sin_beam) {
  return 2.0 * survey.depth_m / survey.sound_speed_mps / std::cos(std::asin(sin_beam) - survey.tilt_rad);
}

}  // namespace ensonify::detect
