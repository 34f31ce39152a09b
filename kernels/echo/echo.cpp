#include "kernels/echo/echo.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/array/line.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;
using Arrival = Workspace::Arrival;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::size_t kRaysPerTask = 1024;
constexpr std::size_t kBins = 4096;  // of sine, -1..1

/// What the receive pattern depends on.
struct Receiver {
  Vec3 position_enu_m;
  Vec3 starboard_enu;  // the array's axis
};

Receiver receiver_at(const ReceiveTrack& track, double time_s) {
  const auto axis = [](const frames::HeadPose& pose) { return Vec3(pose.enu_from_head * Vec3::UnitY()); };
  const std::size_t last = track.poses.size() - 1;
  const double step = std::clamp((time_s - track.start_s) / track.period_s, 0.0, static_cast<double>(last));
  const std::size_t before = std::min(static_cast<std::size_t>(step), last > 0 ? last - 1 : 0);
  const frames::HeadPose& a = track.poses[before];
  if (last == 0) return {a.position_enu_m, axis(a)};
  const frames::HeadPose& b = track.poses[before + 1];
  const double f = step - static_cast<double>(before);
  return {a.position_enu_m + f * (b.position_enu_m - a.position_enu_m),
          (axis(a) + f * (axis(b) - axis(a))).normalized()};
}

std::int32_t first_sample_from(double time_s, const Sampling& sampling) {
  const double index = std::ceil((time_s - sampling.start_s) / sampling.period_s);
  return static_cast<std::int32_t>(std::clamp(index, 0.0, static_cast<double>(sampling.count)));
}

Arrival arrival_of(const Sonar& sonar, const Sampling& sampling, const Transmission& transmission,
                   const ReceiveTrack& track, const random::Stream& phase, std::size_t ray) {
  const trace::Hit& hit = transmission.hits[ray];
  if (!hit.hit()) return {};
  const double R = hit.range_m;
  const Receiver receiver = receiver_at(track, 2.0 * R / sonar.sound_speed_mps);
  const Vec3 back = hit.position_enu_m - receiver.position_enu_m;
  const double R_back = back.norm();

  const double p0_squared = std::pow(10.0, 0.1 * sonar.source_level_db);
  const double b_T = array::line_power(sonar.transmit_length_in_waves, transmission.rays[ray].direction_head.x());
  const double loss = std::pow(10.0, -0.1 * sonar.absorption_dbpm * (R + R_back));
  const double sin_grazing = std::max(static_cast<double>(hit.sin_grazing), 1e-3);
  const double mean_square = p0_squared * b_T * transmission.backscatter[ray] * loss *
                             transmission.rays[ray].solid_angle_sr / (R_back * R_back * sin_grazing);

  const auto amplitude = static_cast<float>(std::sqrt(mean_square));
  const float angle = 2.0F * kPi * 0x1p-32F * static_cast<float>(phase.bits(transmission.ping, ray)[0]);
  const double sine = back.dot(receiver.starboard_enu) / R_back;
  const auto pattern_phase = std::numbers::pi * sonar.receive_length_in_waves * sine;
  const double time_s = (R + R_back) / sonar.sound_speed_mps;
  return {.re_upa = amplitude * std::cos(angle),
          .im_upa = amplitude * std::sin(angle),
          .sine = static_cast<float>(sine),
          .sin_phase = static_cast<float>(std::sin(pattern_phase)),
          .cos_phase = static_cast<float>(std::cos(pattern_phase)),
          .first = first_sample_from(time_s, sampling),
          .end = first_sample_from(time_s + sonar.pulse_length_s, sampling)};
}

std::size_t bin_of(float sine) {
  const float position = (sine + 1.0F) * (0.5F * kBins);
  return static_cast<std::size_t>(std::clamp(position, 0.0F, static_cast<float>(kBins - 1)));
}

/// Counting sort by sine; rays of one bin keep their order, and rays that bring nothing are dropped.
void sort_by_sine(Workspace& workspace) {
  auto& start = workspace.bin_start;
  start.assign(kBins + 1, 0);
  const auto heard = [](const Arrival& arrival) { return arrival.first < arrival.end; };
  for (const Arrival& arrival : workspace.unsorted) {
    if (heard(arrival)) ++start[bin_of(arrival.sine) + 1];
  }
  for (std::size_t bin = 0; bin < kBins; ++bin) start[bin + 1] += start[bin];
  workspace.arrivals.resize(workspace.unsorted.size());
  for (const Arrival& arrival : workspace.unsorted) {
    if (heard(arrival)) workspace.arrivals[start[bin_of(arrival.sine)]++] = arrival;
  }
  // Each start has moved to the end of its bin, which is the next bin's start.
  std::copy_backward(start.begin(), start.end() - 1, start.end());
  start[0] = 0;
}

void add_up(const Sonar& sonar, float sin_beam, const Workspace& workspace, std::span<std::complex<float>> row) {
  const float L = static_cast<float>(sonar.receive_length_in_waves);
  const float reach = static_cast<float>(sonar.receive_reach) / L;
  const double steer = std::numbers::pi * sonar.receive_length_in_waves * sin_beam;
  const auto sin_steer = static_cast<float>(std::sin(steer)), cos_steer = static_cast<float>(std::cos(steer));
  const std::size_t first = workspace.bin_start[bin_of(sin_beam - reach)];
  const std::size_t end = workspace.bin_start[bin_of(sin_beam + reach) + 1];

  std::fill(row.begin(), row.end(), std::complex<float>{});
  float* samples = reinterpret_cast<float*>(row.data());  // (re, im) pairs, as std::complex promises
  for (std::size_t i = first; i < end; ++i) {
    const Arrival& a = workspace.arrivals[i];
    const float x = kPi * L * (a.sine - sin_beam);
    // sinc(x) with sin(x) from the difference of two known phases: no sine in this loop, the busiest of a ping.
    const float sinc = std::abs(x) < 0.01F ? 1.0F : (a.sin_phase * cos_steer - a.cos_phase * sin_steer) / x;
    const float re = sinc * a.re_upa, im = sinc * a.im_upa;
    for (std::int32_t k = a.first; k < a.end; ++k) {
      samples[2 * k] += re;
      samples[2 * k + 1] += im;
    }
  }
}

}  // namespace

void accumulate(const Sonar& sonar, std::span<const float> sin_beams, const Sampling& sampling,
                const Transmission& transmission, const ReceiveTrack& receiver, const random::Stream& phase,
                Workspace& workspace, Image& image) {
  workspace.unsorted.resize(transmission.rays.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, transmission.rays.size(), kRaysPerTask),
      [&](const auto& range) {
        for (std::size_t ray = range.begin(); ray < range.end(); ++ray) {
          workspace.unsorted[ray] = arrival_of(sonar, sampling, transmission, receiver, phase, ray);
        }
      },
      tbb::simple_partitioner());
  sort_by_sine(workspace);

  image.beams = static_cast<int>(sin_beams.size());
  image.samples = sampling.count;
  image.envelope_upa.resize(sin_beams.size() * static_cast<std::size_t>(sampling.count));
  tbb::parallel_for(0, image.beams, [&](int beam) {
    add_up(sonar, sin_beams[static_cast<std::size_t>(beam)], workspace, image.row(beam));
  });
}

void amplitude_upa(const Image& image, std::vector<float>& amplitude) {
  amplitude.resize(image.envelope_upa.size());
  tbb::parallel_for(0, image.beams, [&](int beam) {
    float* out = amplitude.data() + static_cast<std::size_t>(beam) * static_cast<std::size_t>(image.samples);
    for (const auto& p : image.row(beam)) *out++ = std::sqrt(p.real() * p.real() + p.imag() * p.imag());
  });
}

}  // namespace ensonify::echo
