#include "kernels/acoustics/echo/arrival.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kPerTask = 2048;

Arrival direct_echo(const Carrier& carrier, const Vec3& source_enu_m, const Scatterer& scatterer,
                    const Receivers& receivers) {
  const double out_m = (scatterer.position_enu_m - source_enu_m).norm();
  const double out_s = out_m * scatterer.slowness_spm;
  const Receivers::At receiver = receivers.at(2.0 * out_s);  // differs from the arrival by 2 v / c of the travel time
  const Vec3 back = scatterer.position_enu_m - receiver.position_enu_m;
  const double back_m = std::max(back.norm(), 1e-3);

  Arrival arrival;
  arrival.time_s = out_s + back_m * scatterer.slowness_spm;
  const double loss = power_ratio(-carrier.absorption_dbpm * scatterer.stretch * (out_m + back_m));
  const double mean_square = scatterer.scattered_upa2m2 * loss / (scatterer.spreading * back_m * back_m);
  arrival.pressure_upa = scatterer.share * echo_pressure(carrier, mean_square, arrival.time_s, scatterer.response);
  arrival.contributor = scatterer.contributor;
  const Eigen::Vector3f direction_enu = (back / back_m).cast<float>() + scatterer.bend_enu;
  arrival.direction_head = (receiver.head_from_enu * direction_enu).normalized();
  return arrival;
}

}  // namespace

void Receivers::set(const ReceiveTrack& track) {
  if (track.poses.empty()) throw std::invalid_argument("a receiver's track needs at least one pose");
  start_s_ = track.start_s;
  period_s_ = track.period_s;
  poses_.clear();
  for (const frames::HeadPose& pose : track.poses) {
    poses_.push_back({pose.position_enu_m, pose.enu_from_head.conjugate().toRotationMatrix().cast<float>()});
  }
}

Receivers::At Receivers::at(double time_s) const {
  const std::size_t last = poses_.size() - 1;
  const double step = std::clamp((time_s - start_s_) / period_s_, 0.0, static_cast<double>(last));
  if (last == 0) return poses_[0];
  const std::size_t before = std::min(static_cast<std::size_t>(step), last - 1);
  const At &a = poses_[before], &b = poses_[before + 1];
  const double f = step - static_cast<double>(before);
  return {a.position_enu_m + f * (b.position_enu_m - a.position_enu_m),
          a.head_from_enu + static_cast<float>(f) * (b.head_from_enu - a.head_from_enu)};
}

std::complex<float> echo_pressure(const Carrier& carrier, double mean_square_upa2, double time_s,
                                  std::complex<float> response) {
  if (carrier.sum == Sum::kMeanSquare) return {static_cast<float>(mean_square_upa2), 0.0F};
  const double cycles = carrier.frequency_hz * time_s;
  const auto angle = static_cast<float>(-2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
  const std::complex<float> phasor(std::cos(angle), std::sin(angle));
  const auto amplitude = static_cast<float>(std::sqrt(mean_square_upa2));
  const std::complex<float> turned(phasor.real() * response.real() - phasor.imag() * response.imag(),
                                   phasor.real() * response.imag() + phasor.imag() * response.real());
  return amplitude * turned;
}

void add_direct_echoes(const Carrier& carrier, const Vec3& source_enu_m, const Scatterers& scatterers,
                       const Receivers& receivers, Arrivals& arrivals) {
  const std::size_t before = arrivals.size();
  arrivals.resize(before + scatterers.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, scatterers.size(), kPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          arrivals.set(before + i, direct_echo(carrier, source_enu_m, scatterers[i], receivers));
        }
      },
      tbb::simple_partitioner());
}

void TimeIndex::set(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling,
                    const ContributorSet& whose) {
  constexpr std::size_t kArrivalsPerTask = 8192;
  samples_ = sampling.count;
  blocks_ = (samples_ + kBlock - 1) / kBlock;
  reach_ = (pulse.support() + kBlock - 2) / kBlock;
  std::size_t count = 0;
  for (const EchoSet& set : echoes) count += set.arrivals.size();
  trace::make_elements(received_, count);
  const bool all = whose.all();
  Received* received = received_.data();
  for (std::size_t number = 0; number < echoes.size(); ++number) {
    const Arrivals& arrivals = echoes[number].arrivals;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, arrivals.size(), kArrivalsPerTask),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (!all && !whose.holds(arrivals.contributor[i])) {
              received[i].first = samples_;  // left out below, as what comes later than all samples is
              continue;
            }
            const auto place = pulse.place((arrivals.time_s[i] - sampling.start_s) / sampling.period_s);
            received[i] = {place.first, static_cast<std::uint16_t>(place.phase), static_cast<std::uint16_t>(number),
                           static_cast<std::uint32_t>(i)};
          }
        },
        tbb::simple_partitioner());
    received += arrivals.size();
  }
  by_block_.sort(received_, static_cast<std::size_t>(blocks_), [&](const Received& one) {
    const bool outside = one.first >= samples_ || one.first + pulse.support() <= 0;
    return static_cast<std::size_t>(outside ? blocks_ : std::max(one.first, 0) / kBlock);
  });
}

bool TimeIndex::any(int block) const {
  for (int b = first_block(block); b <= block; ++b) {
    if (!by_block_.bucket(static_cast<std::size_t>(b)).empty()) return true;
  }
  return false;
}

}  // namespace ensonify::echo
