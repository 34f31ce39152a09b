#include "kernels/acoustics/echo/run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/base/fast_math/fast_math.h"
#include "kernels/base/isa/wide.h"

namespace ensonify::echo {
namespace {

constexpr double kNearest_m = 1e-3;

/// Of an amplitude in 2^x, for each metre.
float loss_per_m(const Carrier& carrier) {
  return static_cast<float>(-0.05 * std::numbers::ln10 / std::numbers::ln2 * carrier.absorption_dbpm);
}

}  // namespace

ArrivalRows::ArrivalRows(Arrivals& arrivals, std::size_t first)
    : time_s(arrivals.time_s.data() + first),
      pressure_re_upa(arrivals.pressure_re_upa.data() + first),
      pressure_im_upa(arrivals.pressure_im_upa.data() + first),
      x(arrivals.direction_head.x.data() + first),
      y(arrivals.direction_head.y.data() + first),
      z(arrivals.direction_head.z.data() + first),
      contributor(arrivals.contributor.data() + first) {}

ENSONIFY_WIDE void Run::set(const Scatterers& scatterers, std::size_t first, std::size_t count) {
  scatterers_ = &scatterers;
  first_ = first;
  count_ = count;
  const double* const x = scatterers.position_enu_m.x.data() + first;
  const double* const y = scatterers.position_enu_m.y.data() + first;
  const double* const z = scatterers.position_enu_m.z.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    x_m_[i] = x[i] - source_enu_m_.x();
    y_m_[i] = y[i] - source_enu_m_.y();
    z_m_[i] = z[i] - source_enu_m_.z();
    out_m_[i] = std::sqrt(x_m_[i] * x_m_[i] + y_m_[i] * y_m_[i] + z_m_[i] * z_m_[i]);
  }
}

/// Where the receiver is at look_up_s_.
void Run::find_receiver(std::size_t count) {
  receivers_.steps(std::span(look_up_s_).first(count), std::span(step_).first(count), std::span(passed_).first(count));
  Eigen::Vector4d source;
  source << source_enu_m_, 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4d moved = receivers_.position_enu_m(step_[i], passed_[i]) - source;
    receiver_x_m_[i] = moved.x();
    receiver_y_m_[i] = moved.y();
    receiver_z_m_[i] = moved.z();
  }
}

/// The way from there back to scatterers, or to images at this height.
void Run::back_from(const Of& of, const double* height_m) {
  for (std::size_t i = 0; i < of.count; ++i) {
    const double x = of.x_m[i] - receiver_x_m_[i], y = of.y_m[i] - receiver_y_m_[i], z = height_m[i] - receiver_z_m_[i];
    const double back_m = std::max(std::sqrt(x * x + y * y + z * z), kNearest_m);
    const double per_m = 1.0 / back_m;
    back_m_[i] = back_m;
    back_x_[i] = static_cast<float>(x * per_m);
    back_y_[i] = static_cast<float>(y * per_m);
    back_z_[i] = static_cast<float>(z * per_m);
  }
}

Run::Of Run::all() const {
  const Scatterers& of = *scatterers_;
  return {x_m_.data(),
          y_m_.data(),
          z_m_.data(),
          out_m_.data(),
          of.scattered_upa2m2.data() + first_,
          of.cross_section_m2.data() + first_,
          of.response_re.data() + first_,
          of.response_im.data() + first_,
          of.share.data() + first_,
          of.contributor.data() + first_,
          count_};
}

ENSONIFY_WIDE void Run::direct(const ArrivalRows& out) {
  const float* const slowness_spm = scatterers_->slowness_spm.data() + first_;
  for (std::size_t i = 0; i < count_; ++i)  // differs from the arrival by 2 v / c of the travel time
    look_up_s_[i] = 2.0 * out_m_[i] * static_cast<double>(slowness_spm[i]);
  find_receiver(count_);
  back_from(all(), z_m_.data());
  for (std::size_t i = 0; i < count_; ++i) time_s_[i] = (out_m_[i] + back_m_[i]) * static_cast<double>(slowness_spm[i]);
  direct_levels();
  const float* const bend_x = scatterers_->bend_enu.x.data() + first_;
  const float* const bend_y = scatterers_->bend_enu.y.data() + first_;
  const float* const bend_z = scatterers_->bend_enu.z.data() + first_;
  for (std::size_t i = 0; i < count_; ++i) {
    back_x_[i] += bend_x[i];
    back_y_[i] += bend_y[i];
    back_z_[i] += bend_z[i];
  }
  turn_to_head(count_, out);
  for (std::size_t i = 0; i < count_; ++i) {
    const float x = out.x[i], y = out.y[i], z = out.z[i];
    const float scale = 1.0F / std::sqrt(x * x + y * y + z * z);
    out.x[i] = x * scale;
    out.y[i] = y * scale;
    out.z[i] = z * scale;
  }
  arrive(all(), out);
  std::copy_n(scatterers_->contributor.data() + first_, count_, out.contributor);
}

void Run::direct_levels() {
  const float* const stretch = scatterers_->stretch.data() + first_;
  const float* const spreading = scatterers_->spreading.data() + first_;
  const float* const scattered_upa2m2 = scatterers_->scattered_upa2m2.data() + first_;
  const float loss = loss_per_m(carrier_);
  for (std::size_t i = 0; i < count_; ++i) {
    const auto whole_m = static_cast<float>(out_m_[i] + back_m_[i]), back_m = static_cast<float>(back_m_[i]);
    amplitude_upa_[i] =
        std::sqrt(scattered_upa2m2[i] / spreading[i]) / back_m * fast_math::exp2(loss * stretch[i] * whole_m);
  }
}

/// Directions at the head of what comes from back_x_, back_y_, back_z_.
void Run::turn_to_head(std::size_t count, const ArrivalRows& out) const {
  alignas(64) std::array<Eigen::Vector4f, kMost> direction;
  for (std::size_t i = 0; i < count; ++i) {
    direction[i] = receivers_.head_from_enu(step_[i], passed_[i]) * Eigen::Vector3f(back_x_[i], back_y_[i], back_z_[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    out.x[i] = direction[i].x();
    out.y[i] = direction[i].y();
    out.z[i] = direction[i].z();
  }
}

/// Times and pressures, of amplitude_upa_ and time_s_.
void Run::arrive(const Of& of, const ArrivalRows& out) const {
  const std::size_t count = of.count;
  const float *const response_re = of.response_re, *const response_im = of.response_im, *const share = of.share;
  std::copy_n(time_s_.data(), count, out.time_s);
  if (carrier_.sum == Sum::kMeanSquare) {
    for (std::size_t i = 0; i < count; ++i) {
      out.pressure_re_upa[i] = share[i] * (amplitude_upa_[i] * amplitude_upa_[i]);
      out.pressure_im_upa[i] = 0.0F;
    }
    return;
  }
  alignas(64) Column<float> turn;
  const double frequency_hz = carrier_.frequency_hz;
  for (std::size_t i = 0; i < count; ++i) turn[i] = fast_math::part_of_turn(frequency_hz * time_s_[i]);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [cosine, sine] = fast_math::direction(turn[i]);  // of the carrier, which turns the other way
    const float amplitude = share[i] * amplitude_upa_[i];
    out.pressure_re_upa[i] = amplitude * (cosine * response_re[i] + sine * response_im[i]);
    out.pressure_im_upa[i] = amplitude * (cosine * response_im[i] - sine * response_re[i]);
  }
}

/// Images of the scatterers. Returns how many have one.
ENSONIFY_WIDE std::size_t Run::find_images(const Mirror& mirror) {
  const double scale = mirror.scale, shift_m = (scale - 1.0) * source_enu_m_.z() + mirror.shift_m;
  for (std::size_t i = 0; i < count_; ++i) {
    const double z = scale * z_m_[i] + shift_m;
    image_z_m_[i] = z;
    image_out_m_[i] = std::max(std::sqrt(x_m_[i] * x_m_[i] + y_m_[i] * y_m_[i] + z * z), kNearest_m);
  }
  const double level_m = mirror.level_enu_m - source_enu_m_.z(), longest_m = mirror.longest_m;
  std::int32_t images = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::int32_t below = z_m_[i] < level_m ? 1 : 0, early = out_m_[i] + image_out_m_[i] <= longest_m ? 1 : 0;
    has_image_[i] = below & early;
    images += below & early;
  }
  return static_cast<std::size_t>(images);
}

std::size_t Run::count_images(const Mirror& mirror) { return find_images(mirror); }

/// The scatterers that have an image, so many, side by side.
void Run::take(std::size_t images) {
  imaged_ = all();
  if (images == count_) return;
  std::array<std::uint16_t, kMost + 1> index;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    index[taken] = static_cast<std::uint16_t>(i);
    taken += static_cast<std::size_t>(has_image_[i]);
  }
  for (std::size_t k = 0; k < images; ++k) {
    const std::size_t i = index[k];
    imaged_x_m_[k] = x_m_[i], imaged_y_m_[k] = y_m_[i], imaged_z_m_[k] = z_m_[i], imaged_out_m_[k] = out_m_[i];
    image_z_m_[k] = image_z_m_[i], image_out_m_[k] = image_out_m_[i];
    scattered_[k] = imaged_.scattered_upa2m2[i], cross_section_[k] = imaged_.cross_section_m2[i];
    response_re_[k] = imaged_.response_re[i], response_im_[k] = imaged_.response_im[i];
    share_[k] = imaged_.share[i], contributor_[k] = imaged_.contributor[i];
  }
  imaged_ = {imaged_x_m_.data(),
             imaged_y_m_.data(),
             imaged_z_m_.data(),
             imaged_out_m_.data(),
             scattered_.data(),
             cross_section_.data(),
             response_re_.data(),
             response_im_.data(),
             share_.data(),
             contributor_.data(),
             images};
}

ENSONIFY_WIDE array::Directions Run::launch(const Mirror& mirror, const Eigen::Matrix3d& head_from_enu) {
  take(find_images(mirror));
  const double *const x_m = imaged_.x_m, *const y_m = imaged_.y_m;
  const std::size_t count = imaged_.count;
  const Eigen::Matrix3d& R = head_from_enu;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = x_m[i], y = y_m[i], z = image_z_m_[i], per_m = 1.0 / image_out_m_[i];
    launch_x_[i] = static_cast<float>((R(0, 0) * x + R(0, 1) * y + R(0, 2) * z) * per_m);
    launch_y_[i] = static_cast<float>((R(1, 0) * x + R(1, 1) * y + R(1, 2) * z) * per_m);
    launch_z_[i] = static_cast<float>((R(2, 0) * x + R(2, 1) * y + R(2, 2) * z) * per_m);
  }
  const auto first = [count](const Column<float>& all) { return std::span(all).first(count); };
  return {first(launch_x_), first(launch_y_), first(launch_z_)};
}

ENSONIFY_WIDE void Run::by_image(const Mirror& mirror, std::span<const double> sent_upa2m2,
                                 const ArrivalRows& direct_first, const ArrivalRows& image_first) {
  const Of& of = imaged_;
  const std::size_t count = of.count;
  const double* const out_m = of.out_m;
  const double slowness_spm = 1.0 / mirror.sound_speed_mps;
  for (std::size_t i = 0; i < count; ++i) look_up_s_[i] = (out_m[i] + image_out_m_[i]) * slowness_spm;
  find_receiver(count);

  const auto amplitude = static_cast<float>(mirror.amplitude);
  const auto rough = static_cast<float>(-2.0 / std::numbers::ln2 * mirror.roughness_rad * mirror.roughness_rad);
  for (std::size_t i = 0; i < count; ++i) {
    const auto sine = static_cast<float>(image_z_m_[i] / image_out_m_[i]);
    reflected_[i] = -amplitude * fast_math::exp2(rough * sine * sine);  // turned over by a surface that yields
  }
  const float loss = loss_per_m(carrier_);

  back_from(of, image_z_m_.data());
  for (std::size_t i = 0; i < count; ++i) time_s_[i] = (out_m[i] + back_m_[i]) * slowness_spm;
  for (std::size_t i = 0; i < count; ++i) {
    const auto whole_m = static_cast<float>(out_m[i] + back_m_[i]), back_m = static_cast<float>(back_m_[i]);
    amplitude_upa_[i] = reflected_[i] * std::sqrt(of.scattered_upa2m2[i]) / back_m * fast_math::exp2(loss * whole_m);
  }
  by_way_of(mirror, direct_first);

  back_from(of, of.z_m);
  for (std::size_t i = 0; i < count; ++i) time_s_[i] = (image_out_m_[i] + back_m_[i]) * slowness_spm;
  for (std::size_t i = 0; i < count; ++i) {
    const auto whole_m = static_cast<float>(image_out_m_[i] + back_m_[i]);
    const float spread_m2 = static_cast<float>(image_out_m_[i]) * static_cast<float>(back_m_[i]);
    const float insonified = std::sqrt(static_cast<float>(sent_upa2m2[i]) * of.cross_section_m2[i]);
    amplitude_upa_[i] = reflected_[i] * insonified / spread_m2 * fast_math::exp2(loss * whole_m);
  }
  by_way_of(mirror, image_first);
}

void Run::by_way_of(const Mirror& mirror, const ArrivalRows& out) const {
  turn_to_head(imaged_.count, out);
  arrive(imaged_, out);
  const trace::EchoPath path = mirror.path;
  const std::uint32_t* const contributor = imaged_.contributor;
  for (std::size_t i = 0; i < imaged_.count; ++i) out.contributor[i] = trace::by_path(contributor[i], path);
}

}  // namespace ensonify::echo
