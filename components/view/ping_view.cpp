#include "components/view/ping_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "kernels/base/fast_math/fast_math.h"

namespace ensonify {

namespace {

constexpr double kNearestGain_m = 1.0;  // nearer than this a gain is held (kernels/acoustics/echo/gain.h)
constexpr float kDbOfLn = 4.34294482F;  // 10 / ln 10

std::string shape_text(std::size_t beams, std::size_t samples) {
  return std::to_string(beams) + " x " + std::to_string(samples);
}

void require_picture(const msg::Ping& ping) {
  const bool linear = !ping.amplitude_upa.empty();
  if (!linear && ping.amplitude_count.empty()) throw NoPicture("no samples were published with this ping");
  const auto& shape = linear ? ping.amplitude_upa.shape() : ping.amplitude_count.shape();
  if (shape.size() != 2 || shape[0] != ping.beam_angle_rad.size())
    throw NoPicture("amplitudes (" +
                    (shape.size() == 2 ? shape_text(shape[0], shape[1]) : std::string("not beam x sample")) +
                    ") do not fit " + std::to_string(ping.beam_angle_rad.size()) + " beam angles");
  const double step_m = ping.sample_period_s * ping.applied.sound_speed_mps;
  if (!(step_m > 0.0) || !std::isfinite(step_m) || !std::isfinite(ping.first_sample_s))
    throw NoPicture("sample_period_s and sound_speed_mps must be above 0: without them samples have no range");
}

/// Power of a sample's amplitude, in uPa^2, with the wished gain: of counts with the head's own taken out again.
class Power {
 public:
  Power(const msg::Ping& ping, const PictureWish& wish, std::size_t samples) : factor_(samples) {
    const bool linear = !ping.amplitude_upa.empty();
    const msg::AppliedSettings& own = ping.applied;
    for (std::size_t i = 0; i < samples; ++i) {
      const double time_s = ping.first_sample_s + static_cast<double>(i) * ping.sample_period_s;
      const double held_m = std::max(time_s * own.sound_speed_mps / 2.0, kNearestGain_m);
      double gain_db = wish.spreading_db * std::log10(held_m) + 2.0 * wish.absorption_dbpm * held_m;
      if (!linear)
        gain_db -=
            own.gain_spreading_db * std::log10(held_m) + 2.0 * own.gain_absorption_dbpm * held_m + own.gain_offset_db;
      const double unit_upa = linear ? 1.0 : ping.count_upa;
      factor_[i] = static_cast<float>(unit_upa * unit_upa * std::pow(10.0, gain_db / 10.0));
    }
  }
  template <class Sample>
  float of(Sample sample, std::size_t i) const {
    const auto value = static_cast<float>(sample);
    return value * value * factor_[i];
  }

 private:
  std::vector<float> factor_;  // of a squared sample, by its number
};

/// Powers of the cells of one beam.
template <class Sample>
void fill_cells(std::span<const Sample> samples, const Power& power, std::size_t block, bool peak,
                std::span<float> cells) {
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::size_t begin = cell * block;
    const std::size_t end = std::min(begin + block, samples.size());
    float sum = 0.0F;
    float most = 0.0F;
    for (std::size_t i = begin; i < end; ++i) {
      const float value = power.of(samples[i], i);
      sum += value;
      most = std::max(most, value);
    }
    cells[cell] = peak ? most : sum / static_cast<float>(end - begin);
  }
}

float level_db(float power) { return kDbOfLn * fast_math::log(power); }

/// Levels of `powers` (beam x cell), above the floor that fits the strongest.
void set_levels(msg::View& view, std::size_t beams, std::span<const float> powers) {
  view.level = msg::Array<std::uint8_t>({beams, powers.size() / beams});
  const float most = *std::max_element(powers.begin(), powers.end());
  if (most <= 0.0F) return;
  const double floor_db = 10.0 * std::ceil((static_cast<double>(level_db(most)) - 127.0) / 10.0);
  view.level_floor_db = floor_db;
  const float steps_per_ln = kDbOfLn / static_cast<float>(view.level_step_db);
  const float first = 1.5F - static_cast<float>(floor_db / view.level_step_db);  // 1 for the floor, and half to round
  const std::span<std::uint8_t> levels = view.level.flat();
  for (std::size_t i = 0; i < powers.size(); ++i) {  // without branches: it becomes vector code
    const float value = steps_per_ln * fast_math::log(powers[i]) + first;
    const float level = value < 1.0F ? 1.0F : value > 255.0F ? 255.0F : value;
    levels[i] = static_cast<std::uint8_t>(powers[i] > 0.0F ? level : 0.0F);
  }
}

}  // namespace

msg::View view_of(const msg::Ping& ping, const std::string& beam_axis, const PictureWish& wish) {
  require_picture(ping);
  const bool linear = !ping.amplitude_upa.empty();
  const std::size_t beams = ping.beam_angle_rad.size();
  const std::size_t samples = linear ? ping.amplitude_upa.cols() : ping.amplitude_count.cols();
  const std::size_t block = (samples + wish.cells - 1) / wish.cells;
  const std::size_t cells = (samples + block - 1) / block;

  const Power power(ping, wish, samples);
  std::vector<float> powers(beams * cells);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const std::span<float> row{powers.data() + beam * cells, cells};
    if (linear) fill_cells(ping.amplitude_upa.row(beam), power, block, wish.peak, row);
    else fill_cells(ping.amplitude_count.row(beam), power, block, wish.peak, row);
  }
  // A sample that is no finite number would spread over its cell: it counts as nothing received.
  for (float& value : powers)
    if (!(value >= 1e-30F && value <= 1e30F)) value = 0.0F;

  msg::View view;
  view.stamp_ns = ping.stamp_ns;
  view.ping = ping.ping;
  view.kind = ping.kind;
  view.beam_axis = beam_axis;
  view.peak = wish.peak;
  const double half_speed_mps = ping.applied.sound_speed_mps / 2.0;
  view.first_range_m = (ping.first_sample_s - ping.sample_period_s / 2.0) * half_speed_mps;
  view.cell_m = static_cast<double>(block) * ping.sample_period_s * half_speed_mps;
  view.beam_angle_rad = ping.beam_angle_rad;
  view.sound_speed_mps = ping.applied.sound_speed_mps;
  view.range_m = ping.applied.range_m;
  view.frequency_hz = ping.applied.frequency_hz;
  view.pulse_length_s = ping.applied.pulse_length_s;
  view.source_level_db = ping.applied.source_level_db;
  view.gain_spreading_db = ping.applied.gain_spreading_db;
  view.gain_absorption_dbpm = ping.applied.gain_absorption_dbpm;
  view.added_spreading_db = wish.spreading_db;
  view.added_absorption_dbpm = wish.absorption_dbpm;
  if (ping.track.pose_position_enu_m.size() >= 3)
    std::copy_n(ping.track.pose_position_enu_m.data(), 3, view.position_enu_m.begin());
  if (ping.track.pose_enu_from_head.size() >= 4)
    std::copy_n(ping.track.pose_enu_from_head.data(), 4, view.enu_from_head.begin());

  set_levels(view, beams, powers);
  return view;
}

msg::View view_as(const msg::View& view, const PictureWish& wish) {
  const std::size_t beams = view.level.rows();
  const std::size_t fine = view.level.cols();
  const std::size_t block = (fine + wish.cells - 1) / wish.cells;
  if (beams == 0 || (block <= 1 && wish.spreading_db == 0.0 && wish.absorption_dbpm == 0.0)) return view;
  const std::size_t cells = (fine + block - 1) / block;
  std::array<float, 256> power_of{};
  for (std::size_t value = 1; value < power_of.size(); ++value) {
    const double level_db = view.level_floor_db + static_cast<double>(value - 1) * view.level_step_db;
    power_of[value] = static_cast<float>(std::pow(10.0, level_db / 10.0));
  }
  std::vector<float> gain(fine);
  for (std::size_t i = 0; i < fine; ++i) {
    const double middle_m = view.first_range_m + (static_cast<double>(i) + 0.5) * view.cell_m;
    const double held_m = std::max(middle_m, kNearestGain_m);
    gain[i] = static_cast<float>(
        std::pow(10.0, (wish.spreading_db * std::log10(held_m) + 2.0 * wish.absorption_dbpm * held_m) / 10.0));
  }
  std::vector<float> powers(beams * cells);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const std::size_t end = std::min((cell + 1) * block, fine);
      float sum = 0.0F;
      for (std::size_t i = cell * block; i < end; ++i) sum += power_of[view.level(beam, i)] * gain[i];
      powers[beam * cells + cell] = sum / static_cast<float>(end - cell * block);
    }
  }
  msg::View other = view;
  other.cell_m = static_cast<double>(block) * view.cell_m;
  other.added_spreading_db += wish.spreading_db;
  other.added_absorption_dbpm += wish.absorption_dbpm;
  set_levels(other, beams, powers);
  return other;
}

msg::View on_ground(const msg::View& view, double altitude_m) {
  if (!(altitude_m > 0.0) || !(view.cell_m > 0.0)) return view;
  const std::size_t beams = view.level.rows();
  const std::size_t slant = view.level.cols();
  const double far_m = view.first_range_m + static_cast<double>(slant) * view.cell_m;
  const auto cells = static_cast<std::size_t>(std::max(1.0, std::ceil(far_m / view.cell_m)));
  msg::View ground = view;
  ground.first_range_m = 0.0;
  ground.ground_altitude_m = altitude_m;
  ground.level = msg::Array<std::uint8_t>({beams, cells});
  for (std::size_t i = 0; i < cells; ++i) {
    const double slant_m = std::hypot((static_cast<double>(i) + 0.5) * view.cell_m, altitude_m);
    const double at = (slant_m - view.first_range_m) / view.cell_m;
    if (at < 0.0 || at >= static_cast<double>(slant)) continue;
    for (std::size_t beam = 0; beam < beams; ++beam)
      ground.level(beam, i) = view.level(beam, static_cast<std::size_t>(at));
  }
  return ground;
}

void add_finds(msg::View& view, const msg::Soundings& soundings) {
  const std::size_t count = soundings.valid.size();
  if (soundings.beam_angle_rad.size() != count || soundings.travel_time_s.size() != count) return;
  const bool has_kind = soundings.kind.size() == count;
  const auto half_speed_mps = static_cast<float>(soundings.applied.sound_speed_mps / 2.0);
  std::vector<float> angle, range;
  std::vector<std::uint8_t> kind;
  for (std::size_t i = 0; i < count; ++i) {
    const float range_m = soundings.travel_time_s[i] * half_speed_mps;
    if (soundings.valid[i] != 1 || !std::isfinite(range_m) || !std::isfinite(soundings.beam_angle_rad[i])) continue;
    angle.push_back(soundings.beam_angle_rad[i]);
    range.push_back(range_m);
    kind.push_back(has_kind ? soundings.kind[i] : 1);
  }
  view.find_angle_rad = msg::Array<float>::of(std::move(angle));
  view.find_range_m = msg::Array<float>::of(std::move(range));
  view.find_kind = msg::Array<std::uint8_t>::of(std::move(kind));
}

}  // namespace ensonify
