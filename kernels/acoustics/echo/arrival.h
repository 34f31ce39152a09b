#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/receivers.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"

namespace ensonify::echo {

/// 10^(db / 10).
inline double power_ratio(double db) { return std::exp(0.1 * std::numbers::ln10 * db); }

/// A plane wave that comes to the receiver: one scatterer by one path, or another source.
struct Arrival {
  double time_s = 0.0;                                        // of its first sound, after the start of transmission
  std::complex<float> pressure_upa;                           // envelope, rms; phase at the carrier
  Eigen::Vector3f direction_head = Eigen::Vector3f::UnitZ();  // to where it comes from, unit, in the receiver's frame
  std::uint32_t contributor = trace::kNoise;                  // by the path that it took
};

struct Arrivals : trace::Batch<Arrivals, Arrival> {
  std::vector<double> time_s;
  std::vector<float> pressure_re_upa, pressure_im_upa;
  trace::VectorColumns<float> direction_head;
  std::vector<std::uint32_t> contributor;

  Arrivals() = default;
  Arrivals(std::initializer_list<Arrival> arrivals) {
    for (const Arrival& arrival : arrivals) push_back(arrival);
  }
  template <class Self>
  static auto columns(Self& self) {
    auto& direction = self.direction_head;
    return std::tie(self.time_s, self.pressure_re_upa, self.pressure_im_upa, self.contributor, direction.x, direction.y,
                    direction.z);
  }
  std::complex<float> pressure_upa(std::size_t i) const { return {pressure_re_upa[i], pressure_im_upa[i]}; }
  Arrival operator[](std::size_t i) const { return {time_s[i], pressure_upa(i), direction_head[i], contributor[i]}; }
  void set(std::size_t i, const Arrival& arrival) {
    time_s[i] = arrival.time_s;
    pressure_re_upa[i] = arrival.pressure_upa.real();
    pressure_im_upa[i] = arrival.pressure_upa.imag();
    direction_head.set(i, arrival.direction_head);
    contributor[i] = arrival.contributor;
  }
};

/// Some contributors of a ping, or all of them.
class ContributorSet {
 public:
  /// All.
  ContributorSet() = default;
  /// These and no others.
  explicit ContributorSet(std::span<const std::uint32_t> contributors) : all_(false) {
    for (const std::uint32_t one : contributors) {
      if (one >= holds_.size()) holds_.resize(one + 1);
      holds_[one] = true;
    }
  }

  bool all() const { return all_; }
  bool holds(std::uint32_t contributor) const { return all_ || (contributor < holds_.size() && holds_[contributor]); }
  bool operator==(const ContributorSet&) const = default;

 private:
  bool all_ = true;
  std::vector<bool> holds_;  // by contributor
};

/// Arrivals of one origin, and what patterns make of each: amplitudes row by row, one row per aperture, one alone for
/// the elements of a line; empty: 1.
struct EchoSet {
  const Arrivals& arrivals;
  std::span<const float> gain = {};

  bool fits(std::size_t rows) const { return gain.empty() || gain.size() == rows * arrivals.size(); }
};

/// Use of arrivals: sums of pressure with speckle, or sums of mean-square pressure.
enum class Sum { kPressure, kMeanSquare };

struct Carrier {
  double frequency_hz = 300e3;
  double absorption_dbpm = 0.07;  // along the path
  Sum sum = Sum::kPressure;
};

/// The direct echoes of scatterers, one arrival each, in their order; appended to `arrivals`.
///
/// Time: out from the place of transmission and back to where the receiver is at arrival, each the straight distance
/// times the ray's slowness (exact in isovelocity water, first order in the shift of the receiver otherwise).
/// Direction: the ray's own at the head, turned as the straight line is. Mean square: what the scatterer sends back,
/// over the tube's area on the way back (reciprocity), with absorption both ways. Phase: -2 pi f t and that of the
/// scatterer. With Sum::kMeanSquare the pressure holds the mean square itself, uPa^2, phase 0. Errors: run.h.
void add_direct_echoes(const Carrier& carrier, const frames::Vec3& source_enu_m, const Scatterers& scatterers,
                       const Receivers& receivers, Arrivals& arrivals);

/// The pressure of an echo of this mean square, arriving at this time from a scatterer of this response.
std::complex<float> echo_pressure(const Carrier& carrier, double mean_square_upa2, double time_s,
                                  std::complex<float> response);

}  // namespace ensonify::echo
