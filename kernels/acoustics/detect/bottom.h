#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

/// Bottom detection: where in its time series each beam received the seabed, by amplitude and by the phase between the
/// halves of the receive aperture. What an instrument can know goes in: its samples, its own settings, its beams.
namespace ensonify::detect {

/// Gates of a detection. Ranges are slant ranges from the head, depths are below the head along the expected
/// seabed's normal; both at the sound speed of Settings.
struct Gates {
  double min_range_m = 0.0;
  double max_range_m = 1e9;
  double min_depth_m = 0.0;
  double max_depth_m = 1e9;
  double snr_db = 13.0;  // the strongest return must stand this far above the beam's noise
};

/// The echo that reaches a beam by way of bottom, surface and bottom: over a level bottom as if from a depth of 2 H +
/// d, for the altitude H and the depth d of the head. Where the bottom's own fades it may be the strongest.
struct SecondEcho {
  bool refused = false;
  double head_depth_m = 0.0;  // below the surface
};

struct Settings {
  double pulse_length_s = 100e-6;
  Gates gates;
  double sound_speed_mps = 1500.0;  // of the water, as the instrument assumes
  double absorption_dbpm = 0.0;     // likewise
  double receive_length_in_waves = 50.0;
  double phase_centres_in_waves = 25.0;  // from half to half; half the length if they share no element
  double seabed_tilt_rad = 0.0;          // of the expected seabed's normal from the array's, towards positive sines
  int max_detections = 1;                // per beam, 1..kMostDetections
  double second_within_db = 10.0;        // a further detection may be this much weaker than the beam's strongest
  SecondEcho second_echo;
};

inline constexpr int kMostDetections = 8;

/// A beam-by-sample image of linear amplitude, uPa rms; sample k is taken at start_s + k * period_s after transmission.
struct Amplitudes {
  int beams = 0;
  int samples = 0;
  double start_s = 0.0;
  double period_s = 50e-6;
  std::span<const float> amplitude_upa;  // beam by beam
};

/// The same beams as the two halves of the aperture received them, complex envelopes, each steered to the beam's axis,
/// in the layout of Amplitudes (array::split_aperture). The phase of the half on the side of positive sines over the
/// other grows with the sine of arrival. Empty: amplitude alone decides.
struct HalfApertures {
  std::span<const std::complex<float>> positive_upa;
  std::span<const std::complex<float>> negative_upa;
};

/// Flags of a detection: a set of bits.
enum Flag : std::uint16_t {
  kNoSignal = 1,      // nothing was sampled where an echo is allowed, or all of it is zero
  kLowSnr = 2,        // the strongest return does not pass the gate
  kOutOfGate = 4,     // the echo lies outside the ranges or depths of the gates
  kCutOff = 8,        // the record begins after or ends before the echo does
  kPoorFit = 16,      // the phase makes no such ramp (coherence below 0.6, slope 3 times off): amplitude alone decided
  kNotStrongest = 32  // a further detection; the beam has a stronger one
};
inline constexpr std::uint16_t kRejecting = kNoSignal | kLowSnr | kOutOfGate | kCutOff;

struct Detection {
  bool valid = false;  // no bit of kRejecting is set
  std::uint16_t flags = kNoSignal;
  double two_way_s = 0.0;       // from the start of transmission to the start of the echo from the beam's axis
  float range_sd_m = 0.0F;      // predicted standard deviation that the echo's time contributes ...
  float angle_sd_rad = 0.0F;    // ... and that the direction it came from contributes (see below)
  float phase_weight = 0.0F;    // share of the phase in two_way_s, 0..1; above a half it is a phase detection
  float snr_db = 0.0F;          // strongest return over noise; also given when it fails the gate
  float echo_energy_db = 0.0F;  // of the whole echo, noise taken off, dB re 1 uPa^2 s
  float quality = 0.0F;         // -log10 of the predicted relative standard deviation of the depth [Lurton2010b]
  int snippet_first = 0;        // the samples that hold the echo: [snippet_first, snippet_first + snippet_count)
  int snippet_count = 0;
};

/// Detections of every beam: detections is resized to beams x max_detections and overwritten; beam b has entries
/// b * max_detections onward, found ones first, in order of time. Independent of the number of threads; allocates only
/// while detections grows, and for second echoes that it refuses.
///
/// Noise: median power of the beam over ln 2 (noise power is exponential), from at most 256 samples spread evenly; sd
/// 0.4 dB.
///
/// Gate: the strongest return is the largest mean power over one pulse. Of noise alone a beam passes the gate G (a
/// ratio) with probability below N P(Gamma(n, 1/n) > G), for N samples searched and n samples per pulse: below 1e-5 at
/// 13 dB for N = 2000 and n = 1, below 1e-12 for n = 2. No power at all is no detection. If nothing passes inside the
/// range and depth gates but something does outside, the beam says kOutOfGate.
///
/// Amplitude: the centre of gravity in a window of twice the time that the beam's half-power footprint takes on the
/// expected seabed, centred on itself in four passes. Power weighs with R^2 10^(2 alpha R / 10), as a level Lambert
/// seabed makes it fall per sine inside a beam, and 1 / t^2 is averaged, which is linear in the square of that sine.
/// Together they keep the bias below 0.05 % of depth at 60 deg for 1 deg beams, where a plain centre of gravity has
/// 0.2 %.
///
/// Phase: on a plane, the phase between the halves is linear in the sine from which it sends an echo at that time, so
/// a line fitted against that sine has none of the curvature bias of a line fitted against time. Offset and slope are
/// fitted to the interferogram turned back by the model, in at most six passes; the slope is pulled towards that of the
/// expected seabed as by a prior of 50 %. Samples weigh with the interferogram's magnitude, over 1.5 half-power
/// footprints.
///
/// Both are blended with the inverses of their predicted variances. These come from the echo itself: for amplitude,
/// speckle of the measured spread (1.5 independent samples a pulse), noise, and the sampling interval; for phase, the
/// scatter of pulse-long sums of the residuals. An error of the direction moves the echo along the seabed: on the
/// expected one, range_sd_m and R tan(incidence) angle_sd_rad are both errors of the range at the beam's axis and
/// add as squares.
///
/// Further detections: the strongest returns outside the snippets found so far that pass the gate and second_within_db.
///
/// Second echo: makers set a gate about the swath's bottom, within 15 to 20 % of its depth [Teledyne2019] or up to 90 %
/// [R2Sonic2014], so that the second return is not searched. Here the gate is made of the ping itself, and shuts out
/// nothing else: a beam with a detection within 5 % of 2 B + d is sought through again, short of that depth. B is the
/// depth that the beams about it receive: the median over the strongest detections within five half-power widths, of
/// the side where it is deeper. A drop to twice the depth so stays wherever one side of a beam is down there too;
/// within half of those widths of an end of the swath the inner side decides. What is lost is a hole of just that
/// depth, narrower than five widths; it keeps its edges if it is wider than half of that. A beam that receives nothing
/// else says kOutOfGate.
///
/// sin_beams: one per beam, sine from the plane across the array. std::invalid_argument if images and beams differ in
/// size, max_detections is outside 1..kMostDetections, or a length, period or speed is not above 0.
void detect_bottom(const Settings& settings, std::span<const float> sin_beams, const Amplitudes& image,
                   const HalfApertures& halves, std::vector<Detection>& detections);

/// By amplitude alone.
void detect_bottom(const Settings& settings, std::span<const float> sin_beams, const Amplitudes& image,
                   std::vector<Detection>& detections);

/// Area that a beam of a Mills cross sees on a level seabed, m^2, both patterns as rectangles of equal area:
/// R^2 (lambda / L_T) (lambda / L_R) / cos^2(beam). With it the energy of a detection gives the backscatter strength,
/// Sb = echo_energy_db - 10 log10(pulse) - SL + 40 log10 R + 2 alpha R - 10 log10(area).
double beam_area_m2(double range_m, double sin_beam, double transmit_length_in_waves, double receive_length_in_waves);

}  // namespace ensonify::detect
