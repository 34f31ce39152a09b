#include "kernels/acoustics/echo/volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace ensonify::echo {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPart_rad = 3.0 * kPi / 180.0;

using Power = std::function<double(const Eigen::Vector3f&)>;

/// The layers as a table, so that a lookup costs no call.
class Table {
 public:
  explicit Table(const VolumeLayers& layers) : per_step_(1.0 / layers.step_m) {
    if (!(layers.deepest_m > 0.0)) return;
    const auto steps = static_cast<std::size_t>(std::ceil(layers.deepest_m / layers.step_m)) + 1;
    for (std::size_t i = 0; i < steps; ++i) {
      values_.push_back(static_cast<float>(layers.backscatter_per_m((static_cast<double>(i) + 0.5) * layers.step_m)));
    }
  }
  float at(double depth_m) const {
    const double i = depth_m * per_step_;
    return i >= 0.0 && i < static_cast<double>(values_.size()) ? values_[static_cast<std::size_t>(i)] : 0.0F;
  }

 private:
  double per_step_;
  std::vector<float> values_;
};

}  // namespace

VolumeDirections VolumeDirections::of(const Power& power, const Eigen::Vector3f& axis_head, double u_from, double u_to,
                                      double step_rad) {
  if (!(step_rad > 0.0)) throw std::invalid_argument("a step between directions must be positive");
  const Eigen::Vector3f axis = axis_head.normalized();
  const Eigen::Vector3f beside = axis.unitOrthogonal(), third = axis.cross(beside);
  struct Part {
    double solid_angle_sr = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  };
  std::map<std::pair<int, int>, Part> parts;
  const double from = std::clamp(u_from, -1.0, 1.0), to = std::clamp(u_to, -1.0, 1.0);
  const int rows = std::max(1, static_cast<int>(std::ceil((to - from) / step_rad)));
  const int around = static_cast<int>(std::ceil(2.0 * kPi / step_rad));
  const double solid_angle_sr = (to - from) / rows * 2.0 * kPi / around;
  for (int row = 0; row < rows; ++row) {
    const double u = from + (to - from) * (row + 0.5) / rows, radius = std::sqrt(std::max(0.0, 1.0 - u * u));
    for (int i = 0; i < around; ++i) {
      const double phi = 2.0 * kPi * (i + 0.5) / around;
      const Eigen::Vector3f direction = static_cast<float>(u) * axis +
                                        static_cast<float>(radius * std::cos(phi)) * beside +
                                        static_cast<float>(radius * std::sin(phi)) * third;
      const double weight = power(direction) * solid_angle_sr;
      if (!(weight > 0.0)) continue;
      Part& part = parts[{static_cast<int>(std::asin(u) / kPart_rad + 1000.0), static_cast<int>(phi / kPart_rad)}];
      part.solid_angle_sr += weight;
      part.sum += weight * direction.cast<double>();
    }
  }
  double largest = 0.0;
  for (const auto& [place, part] : parts) largest = std::max(largest, part.solid_angle_sr);
  VolumeDirections found;
  for (const auto& [place, part] : parts) {
    if (part.solid_angle_sr < 1e-7 * largest) continue;
    found.directions.push_back({part.sum.normalized().cast<float>(), static_cast<float>(part.solid_angle_sr)});
  }
  return found;
}

std::vector<VolumeDirections> directions_of_cells(const LineReceiver& receiver, const Power& power, double step_rad) {
  const double spacing = receiver.line().spacing_in_waves;
  const double width = 1.0 / (receiver.cells() * spacing);
  const int aliases = static_cast<int>(std::ceil(spacing)) + 1;
  std::vector<VolumeDirections> cells(static_cast<std::size_t>(receiver.cells()));
  for (int cell = 0; cell < receiver.cells(); ++cell) {
    auto& all = cells[static_cast<std::size_t>(cell)].directions;
    for (int alias = -aliases; alias <= aliases; ++alias) {
      const double middle = receiver.cell_sine(cell) + alias / spacing;
      const double from = std::max(-1.0, middle - 0.5 * width), to = std::min(1.0, middle + 0.5 * width);
      if (from >= to) continue;
      const auto one = VolumeDirections::of(power, receiver.line().axis_head, from, to, step_rad);
      all.insert(all.end(), one.directions.begin(), one.directions.end());
    }
  }
  return cells;
}

void reverberation_upa2(double source_level_db, double absorption_dbpm, double sound_speed_mps,
                        std::span<const VolumeDirections> channels, const VolumeLayers& layers,
                        const frames::HeadPose& pose, const Pulse& pulse, const Sampling& sampling,
                        std::vector<float>& mean_square_upa2) {
  const Table table(layers);
  const Eigen::Vector3f up_head = (pose.enu_from_head.conjugate() * frames::Vec3::UnitZ()).cast<float>();
  const double head_depth_m = -pose.position_enu_m.z(), tau = pulse.equivalent_length_s();
  const double middle_s = 0.5 * (pulse.start_s + pulse.end_s());
  mean_square_upa2.resize(static_cast<std::size_t>(sampling.count) * channels.size());
  tbb::parallel_for(0, sampling.count, [&](int sample) {
    const double time_s = sampling.time_s(sample) - middle_s;
    const double R = 0.5 * sound_speed_mps * time_s;
    float* out = mean_square_upa2.data() + static_cast<std::size_t>(sample) * channels.size();
    if (R < 0.25 * sound_speed_mps * tau) {
      std::fill_n(out, channels.size(), 0.0F);
      return;
    }
    const double per_scatter =
        std::pow(10.0, 0.1 * (source_level_db - 2.0 * absorption_dbpm * R)) / (R * R) * 0.5 * sound_speed_mps * tau;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      double sum = 0.0;
      for (const auto& part : channels[c].directions) {
        const double depth_m = head_depth_m - R * part.direction_head.dot(up_head);
        sum += static_cast<double>(table.at(depth_m)) * part.solid_angle_sr;
      }
      out[c] = static_cast<float>(per_scatter * sum);
    }
  });
}

}  // namespace ensonify::echo
