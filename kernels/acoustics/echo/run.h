#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/acoustics/array/pattern.h"
#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/receivers.h"
#include "kernels/acoustics/echo/scatterer.h"

namespace ensonify::echo {

/// Rows of arrivals from one on, to be written.
struct ArrivalRows {
  double* time_s;
  float *pressure_re_upa, *pressure_im_upa, *x, *y, *z;
  std::uint32_t* contributor;

  ArrivalRows(Arrivals& arrivals, std::size_t first);
};

/// A few scatterers that follow each other, and their echoes: numbers in columns, one loop for each, so that they are
/// vector code. What several echoes of a scatterer need is computed once. Time, distance and cycles of the carrier are
/// double, the rest float.
///
/// Against the same formulas in double with the C library's functions (run_test.cpp): time 1e-13 of it, phase 5e-7 rad,
/// level 2e-5 dB, direction 3e-7.
class Run {
 public:
  static constexpr std::size_t kMost = 256;  // their columns stay in the first cache

  Run(const Carrier& carrier, const Receivers& receivers, const frames::Vec3& source_enu_m)
      : carrier_(carrier), receivers_(receivers), source_enu_m_(source_enu_m) {}

  /// Up to kMost scatterers from `first` on.
  void set(const Scatterers& scatterers, std::size_t first, std::size_t count);

  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }

  /// Echoes straight out and back.
  void direct(const ArrivalRows& out);

  /// A mirror image of the scatterers: each at `scale` of its height and `shift_m` above that. A reflection leaves
  /// -amplitude exp(-2 (roughness_rad sin)^2), at the angle at which the way from the head to the image is steep.
  struct Mirror {
    double scale, shift_m;
    double amplitude, roughness_rad;  // k sigma
    double level_enu_m;               // what stands above it has no image
    double longest_m;                 // way out and back; longer ones have none either
    double sound_speed_mps;
    trace::EchoPath path;
  };
  /// How many of the scatterers have an image.
  std::size_t count_images(const Mirror& mirror);
  /// Takes these scatterers for by_image(). Returns where the way from the head to the images leaves, in its frame.
  array::Directions launch(const Mirror& mirror, const Eigen::Matrix3d& head_from_enu);
  /// Echoes out directly and back from the image, and in the other order. `sent` leaves towards the images,
  /// uPa^2 m^2. After launch() for the same mirror.
  void by_image(const Mirror& mirror, std::span<const double> sent_upa2m2, const ArrivalRows& direct_first,
                const ArrivalRows& image_first);

 private:
  template <class T>
  using Column = std::array<T, kMost>;

  /// Scatterers that echoes are made of: columns of the run, or of those of it that have an image.
  struct Of {
    const double *x_m, *y_m, *z_m, *out_m;
    const float *scattered_upa2m2, *cross_section_m2, *response_re, *response_im, *share;
    const std::uint32_t* contributor;
    std::size_t count;
  };
  Of all() const;
  std::size_t find_images(const Mirror& mirror);
  void take(std::size_t images);
  void find_receiver(std::size_t count);
  void back_from(const Of& of, const double* height_m);
  void direct_levels();
  void turn_to_head(std::size_t count, const ArrivalRows& out) const;
  void arrive(const Of& of, const ArrivalRows& out) const;
  void by_way_of(const Mirror& mirror, const ArrivalRows& out) const;

  const Carrier& carrier_;
  const Receivers& receivers_;
  frames::Vec3 source_enu_m_;
  const Scatterers* scatterers_ = nullptr;
  std::size_t first_ = 0, count_ = 0;
  // Of the scatterers, from the head at transmission.
  alignas(64) Column<double> x_m_, y_m_, z_m_, out_m_;
  // Of their images, and which scatterers have one; then of these alone.
  alignas(64) Column<double> image_z_m_, image_out_m_;
  alignas(64) Column<std::int32_t> has_image_;
  Of imaged_{};
  alignas(64) Column<double> imaged_x_m_, imaged_y_m_, imaged_z_m_, imaged_out_m_;
  alignas(64) Column<float> scattered_, cross_section_, response_re_, response_im_, share_;
  alignas(64) Column<std::uint32_t> contributor_;
  alignas(64) Column<float> launch_x_, launch_y_, launch_z_;
  // Of the receiver then: where it is, from the head at transmission.
  alignas(64) Column<double> look_up_s_, passed_, receiver_x_m_, receiver_y_m_, receiver_z_m_;
  alignas(64) Column<std::int32_t> step_;
  // Of the echo that is being made.
  alignas(64) Column<double> back_m_, time_s_;
  alignas(64) Column<float> back_x_, back_y_, back_z_;  // unit, ENU, to where it comes from
  alignas(64) Column<float> amplitude_upa_;             // rms, with sign
  alignas(64) Column<float> reflected_;
};

/// Calls work(run, number) for the runs of all scatterers, in tasks of four, whatever the number of threads.
template <class Work>
void for_runs(const Carrier& carrier, const Receivers& receivers, const frames::Vec3& source_enu_m,
              const Scatterers& scatterers, const Work& work) {
  constexpr std::size_t kRunsPerTask = 4;
  const std::size_t runs = (scatterers.size() + Run::kMost - 1) / Run::kMost;
  tbb::parallel_for(std::size_t{0}, (runs + kRunsPerTask - 1) / kRunsPerTask, [&](std::size_t task) {
    Run run(carrier, receivers, source_enu_m);
    for (std::size_t number = task * kRunsPerTask; number < std::min(runs, (task + 1) * kRunsPerTask); ++number) {
      const std::size_t first = number * Run::kMost;
      run.set(scatterers, first, std::min(Run::kMost, scatterers.size() - first));
      work(run, number);
    }
  });
}

}  // namespace ensonify::echo
