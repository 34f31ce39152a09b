#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/beam_rows.h"
#include "kernels/acoustics/echo/grid_point.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/spreading.h"
#include "kernels/acoustics/echo/time_index.h"
#include "kernels/base/fft/transform.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// Equal elements on a straight line, at one frequency.
struct ElementLine {
  int elements = 100;
  double spacing_in_waves = 0.5;                         // above 0.5 the line has grating lobes, and so has this model
  Eigen::Vector3f axis_head = Eigen::Vector3f::UnitY();  // unit, head frame
};

/// Sound that is there without any arrival, as mean squares per sample. It is white before the receiver's filter
/// (SampledPulse::response), so coloured in time as echoes are. Each of the three draws from its own stream, by (ping,
/// sample, place) only; a level of zero or an empty span leaves it out without a change to the others.
struct Background {
  std::uint64_t ping = 0;
  double isotropic_upa2 = 0.0;  // ambient noise at one element, in the receiver's band, equal from all directions
  const random::Stream* isotropic = nullptr;
  double electronic_upa2 = 0.0;  // of each element's own electronics, as sound; 160 dB below the isotropic: not drawn
  const random::Stream* electronic = nullptr;
  /// Volume reverberation: sample by cell of the receiver's sine grid.
  std::span<const float> volume_upa2;
  const random::Stream* volume = nullptr;
};

/// Sums of arrivals over a line's elements, read as beams with their full side lobes, at a cost that does not depend on
/// how many arrivals each beam receives. LineReceiver uses it for pressures and for mean squares.
///
/// Arrivals go onto a grid of sample by sine (phase between elements), spread over six points (Spreading); for each
/// sample a Fourier transform along sine gives the elements' signals; they are weighted; a second transform and the
/// same six points give beams at any sine. Differs from the direct sum over elements by less than 1e-5 of the peak. The
/// array is narrow-band: an arrival's envelope reaches all elements at once. Element m of M stands at
/// (m - floor(M / 2)) spacings along the axis, and that of number floor(M / 2) is the reference of phase.
///
/// Isotropic noise has the correlation sin(2 pi x) / (2 pi x) between elements x waves apart: none at half waves. Where
/// elements stand within 1 % of half a wave they draw their own; beams then receive it within 0.05 dB.
///
/// Blocks of samples are independent and each sums in a fixed order, set by set: the same bits for any number of
/// threads, and for arrivals in one set or in several.
class LineGrid {
 public:
  /// Throws std::invalid_argument for no elements or a spacing that is not positive.
  explicit LineGrid(const ElementLine& line);

  const ElementLine& line() const { return line_; }

  /// Cells of the sine grid, for Background::volume_upa2, and the sine at the middle of one (unaliased, in
  /// -0.5/spacing..0.5/spacing).
  int cells() const { return cells_; }
  double cell_sine(int cell) const;
  /// Mean square of the isotropic noise in a beam, over that at one element; of the autocorrelation of its weights.
  double isotropic_power(std::span<const float> power_weights, double sin_beam) const;

  /// Input of one ping. Spans are not owned.
  struct Input {
    std::span<const EchoSet> echoes;  // with the amplitude pattern of an element
    const ContributorSet& whose;      // of them
    const SampledPulse& pulse;
    Sampling sampling;
    Background background;
  };

  /// Memory of forming, of any receiver: its contents do not matter.
  class Memory {
    friend LineGrid;
    struct Steer {  // where a beam reads the grid
      int first;
      Spreading::Taps taps;
    };
    struct Thread {
      std::vector<std::complex<float>> grid, elements, spectrum, field, sum;
      std::vector<float> scale;  // of elements
      // Draws of a block and of what its filter reaches back to: by sample and cell, or sample and element.
      std::vector<std::complex<float>> volume, isotropic, noise;
      std::array<BeamRows, 2> rows;  // of one or two sets of weights
    };
    ByTime<GridPoint> points;
    std::vector<Steer> steer;
    std::vector<Thread> threads;
  };

  /// One image (beam by sample) for each set of element weights; images are resized and overwritten. sin_beams: sines
  /// of the beams' axes along the line's axis, true, any order. Of three sets of weights of which the first is the sum
  /// of the others (a whole and its halves), the first image costs an addition only. Where amplitude_upa (beam by
  /// sample) is given for these, its magnitudes come there and its envelope stays empty. Returns whether they did.
  bool form(const Input& input, std::span<const float> sin_beams, std::span<const std::span<const float>> weights,
            std::span<Image> images, std::span<float> amplitude_upa, Memory& memory) const;

 private:
  using Steer = Memory::Steer;
  using Thread = Memory::Thread;

  void check(const Input& input, std::span<const std::span<const float>> weights, std::size_t images) const;
  double share_of_sphere(int cell) const;
  SineGrid grid() const { return {line_.axis_head, line_.spacing_in_waves, cells_}; }
  /// Isotropic noise as a field, where it is not independent from element to element ...
  bool hears_field(const Background& background) const { return background.isotropic_upa2 > 0.0 && !white_; }
  /// ... and what each element has of its own.
  static bool hears_electronic(const Background& background);
  bool hears_elements(const Background& background) const {
    return (background.isotropic_upa2 > 0.0 && white_) || hears_electronic(background);
  }
  /// use(m, index of element m in a transform): those before the middle, then the others.
  template <class Use>
  void for_harmonics(const Use& use) const {
    const int half = line_.elements / 2;
    for (int m = 0; m < half; ++m) use(m, m - half + cells_);
    for (int m = half; m < line_.elements; ++m) use(m, m - half);
  }
  void draw(const Input& input, int block, Thread& memory) const;
  static void filter(const Input& input, int r, std::span<const std::complex<float>> draws,
                     std::span<std::complex<float>> sum);
  void make_field(const Input& input, int block, int sample, Thread& memory) const;
  void to_elements(const Input& input, int block, int sample, Thread& memory) const;
  void to_beam_grid(int samples, std::span<const float> weights, Thread& memory) const;
  struct Form {
    bool halved;                     // the first set of weights is the sum of two others
    std::span<float> amplitude_upa;  // of its image; empty: the image as a whole
  };
  static void silence(int first, int samples, std::span<Image> images, const Form& form);
  static void read_beams(int block, int samples, std::span<const Steer> steers, std::span<const BeamRows> rows,
                         std::span<Image> images, const Form& form);
  void form_block(const Input& input, int block, std::span<const std::span<const float>> weights, const Form& form,
                  Memory& memory, std::span<Image> images) const;

  ElementLine line_;
  int cells_, stride_;
  Spreading spreading_;
  fft::Transform to_elements_, to_beams_;
  std::vector<float> unspread_;         // by element
  bool white_;                          // isotropic noise is independent from element to element
  std::vector<float> isotropic_share_;  // by cell, amplitude; empty if white
};

}  // namespace ensonify::echo
