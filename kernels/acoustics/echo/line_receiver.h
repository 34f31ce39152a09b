#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/line_grid.h"
#include "kernels/acoustics/echo/multipath.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// The elements of an array (kernels/acoustics/array) along an axis.
ElementLine element_line(const array::LineArray& array, double wavelength_m,
                         const Eigen::Vector3f& axis_head = Eigen::Vector3f::UnitY());

/// Element weights (kernels/acoustics/array: shading, parts of a split aperture) for a beam that answers 1 to a plane
/// wave from its axis: divided by their own sum or, for parts, by the whole array's, so that parts add up to it.
std::vector<float> beam_weights(std::span<const double> weights);
std::vector<float> beam_weights(std::span<const double> weights, std::span<const double> whole);

/// What beams of these weights share of two directions, for power_gains: the pattern of the squared weights.
SharedByBeams shared_by_beams(const ElementLine& line, std::span<const float> weights);

/// An image that a line is to form: through which weights of its elements, how echoes are summed, and whose they are.
struct WantedImage {
  explicit WantedImage(std::vector<float> of_elements, Sum how = Sum::kPressure, ContributorSet whose = {});

  std::vector<float> weights;
  /// kMeanSquare: arrivals hold mean squares. The root of their sum, as of a wave of phase 0, stands in the field of
  /// the background.
  Sum sum;
  ContributorSet contributors;
  std::vector<float> power_weights;  // of kMeanSquare: a pattern's power is the transform of its weights'
                                     // autocorrelation
};

/// Images of a line array: beams with their full side lobes (LineGrid), in the field of what is there without echoes.
class LineReceiver {
 public:
  /// mean_squares: whether images of mean squares may be wanted.
  explicit LineReceiver(const ElementLine& line, bool mean_squares = false);

  const ElementLine& line() const { return pressure_.line(); }
  /// Cells of the sine grid, for Background::volume_upa2, and the sine at the middle of one.
  int cells() const { return pressure_.cells(); }
  double cell_sine(int cell) const { return pressure_.cell_sine(cell); }
  /// Mean square of isotropic noise in an image of mean squares, at a beam, over that at one element.
  double isotropic_power(const WantedImage& image, double sin_beam) const {
    return pressure_.isotropic_power(image.power_weights, sin_beam);
  }

  /// Input of one ping. Spans are not owned.
  struct Input {
    std::span<const EchoSet>
        echoes;  // with the amplitude pattern of an element; of mean squares its power (power_gains)
    const SampledPulse& pulse;
    Sampling sampling;
    Background background;                  // of the contributor trace::kNoise
    const SampledPulse* squared = nullptr;  // for mean squares: the pulse's
    /// Beam by sample: where there is room, the first image's magnitudes. Whether its envelope is kept then is open.
    std::span<float> amplitude_upa = {};
    /// For mean squares: echoes that are pressures all the same, as those of smooth bodies. The mean square of their
    /// sum is added.
    std::span<const EchoSet> coherent = {};
  };

  /// Memory of forming: its contents do not matter.
  class Memory {
    friend LineReceiver;
    LineGrid::Memory grid;
    std::vector<std::span<const float>> weights;
    std::vector<Image> mean_square = std::vector<Image>(1), coherent;
  };

  /// Images are resized and overwritten. sin_beams: sines of the beams' axes along the line's axis, true, any order.
  /// Pressures of images of some contributors each add up to that of all of them. Neighbours of the same contributors
  /// and sum share all but their weights; where of three the first's are the sum of the others' (a whole and its
  /// halves), that image costs an addition only. Throws std::invalid_argument for what does not fit.
  void form(const Input& input, std::span<const float> sin_beams, std::span<const WantedImage> wanted,
            std::span<Image> images, Memory& memory) const;

 private:
  /// Returns whether the amplitudes of the first image are there.
  bool form_alike(const Input& input, std::span<const float> sin_beams, std::span<const WantedImage> wanted,
                  std::span<Image> images, std::span<float> amplitude_upa, Memory& memory) const;

  LineGrid pressure_;
  std::optional<LineGrid> power_;
};

}  // namespace ensonify::echo
