#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ensonify::echo {

/// Sampling of a receiver: sample k is taken at start_s + (first + k) * period_s after the start of transmission.
struct Sampling {
  double start_s = 0.0;
  double period_s = 50e-6;  // Pulse says how long it may be
  int count = 0;
  int first = 0;  // of a window: a part of an image is formed bit by bit as the whole

  double time_s(int k) const { return start_s + (first + k) * period_s; }
};

/// Complex envelope, beam by sample: the square of the magnitude is mean-square pressure at the receiver, uPa^2, as the
/// equivalent plane wave on the beam's axis.
struct Image {
  int beams = 0;
  int samples = 0;
  std::vector<std::complex<float>> envelope_upa;  // row by row, one row per beam

  /// Contents are kept only when the size stays.
  void resize(int new_beams, int new_samples) {
    beams = new_beams;
    samples = new_samples;
    envelope_upa.resize(static_cast<std::size_t>(beams) * static_cast<std::size_t>(samples));
  }
  std::span<std::complex<float>> row(int beam) {
    return std::span(envelope_upa)
        .subspan(static_cast<std::size_t>(beam) * static_cast<std::size_t>(samples), static_cast<std::size_t>(samples));
  }
  std::span<const std::complex<float>> row(int beam) const {
    return std::span(envelope_upa)
        .subspan(static_cast<std::size_t>(beam) * static_cast<std::size_t>(samples), static_cast<std::size_t>(samples));
  }
};

/// Magnitude of the envelope, uPa rms, beam by sample; resized.
void amplitude_upa(const Image& image, std::vector<float>& amplitude);
/// The same, in place: one number for each sample.
void amplitude_upa(const Image& image, std::span<float> amplitude);

}  // namespace ensonify::echo
