#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace ensonify::echo {

/// Echo of one point behind the receiver's filter: its envelope against the time since the echo's start
/// arrived. The peak is 1, so an echo keeps its level (rms during the pulse) whatever the pulse.
///
/// For a compressed chirp the filter's delay is taken out: the peak stands at time 0. Its side lobes have their signs.
struct Pulse {
  double duration_s = 0.0;          // of the transmission
  double start_s = 0.0;             // of the first entry
  double step_s = 0.0;              // between entries; linear between them, 0 outside
  std::vector<double> envelope;     // at least two entries
  double bandwidth_hz = 0.0;        // complex samples at 2 x this rate or faster keep every echo
  double noise_bandwidth_hz = 0.0;  // white noise of level N0 (dB re uPa^2/Hz) leaves N0 + 10 log10 of this
  double processing_gain_db = 0.0;  // signal to noise after the filter over that in the band before it

  double at(double time_s) const;
  double end_s() const;
  /// Integral of the squared envelope: a rectangle of this length and height 1 brings as much energy.
  double equivalent_length_s() const;
  /// Throws std::invalid_argument when samples this far apart let echoes fall between them.
  void check_period(double period_s) const;
};

/// A tone of constant amplitude. length_s > 0.
Pulse rectangular_pulse(double length_s);

/// A tone whose first and last `tapered_fraction` / 2 of the length rise and fall as a raised cosine (Tukey window
/// [Harris1978]); 0 is rectangular, 1 is Hann. Its matched filter gives the noise bandwidth; the envelope is that of
/// the transmission.
Pulse tapered_pulse(double length_s, double tapered_fraction);

/// Weighting of the matched filter's reference: it trades width and a little gain for lower side lobes [Harris1978].
enum class Window { kNone, kHann, kHamming, kBlackman };

/// A linear FM sweep over `bandwidth_hz` in `length_s`, after its matched filter [Klauder1960]. Width 1 / bandwidth
/// (resolution c / 2B), gain 10 log10(bandwidth x length) without window. Side lobes below `dynamic_range_db` are cut
/// where the rest of the tail is below it; the narrower the range, the faster the echo. bandwidth x length >= 4 (below,
/// the sweep is no longer one and std::invalid_argument says so). The same at every Doppler shift (v << c).
Pulse compressed_chirp(double length_s, double bandwidth_hz, Window window = Window::kNone,
                       double dynamic_range_db = 40.0);

/// A pulse on a receiver's samples: one row of numbers for each of kPhases places of the arrival between two samples,
/// so an echo is right to 1 / (2 kPhases) of a sample period.
class SampledPulse {
 public:
  static constexpr int kPhases = 128;

  /// Throws std::invalid_argument when the period is too long for the pulse.
  SampledPulse(const Pulse& pulse, double period_s);

  /// The squares, for sums of mean-square pressure.
  SampledPulse squared() const;

  /// First sample of an echo that arrives `periods` sample periods after sample 0.
  struct Place {
    int first;  // sample
    int phase;
  };
  Place place(double periods) const { return grid().at(periods); }
  /// The same by value, for vector code.
  struct Grid {
    double start_in_periods;

    Place at(double periods) const {
      constexpr double kFar = 1e9;  // samples: beyond every window, within an int
      const double begin = std::clamp(periods + start_in_periods, -kFar, kFar);
      const double first = std::ceil(begin);
      return {static_cast<int>(first), std::min(kPhases - 1, static_cast<int>((first - begin) * kPhases))};
    }
  };
  Grid grid() const { return {start_in_periods_}; }

  /// The receiver's filter as white sound passes it, noise and reverberation: the echo of one point, of energy 1. So
  /// what is white before it, of mean square 1 a sample, keeps that and has the spectrum of echoes.
  std::span<const float> response() const { return response_; }

  int support() const { return support_; }
  std::span<const float> row(int phase) const {
    return std::span(table_).subspan(static_cast<std::size_t>(phase) * static_cast<std::size_t>(support_),
                                     static_cast<std::size_t>(support_));
  }

 private:
  int support_;
  double start_in_periods_;
  std::vector<float> table_, response_;
};

}  // namespace ensonify::echo
