#pragma once

#include <span>

/// From snippets (uncorrected amplitude against time, uPa) to a seabed image (dB after a stated gain law and
/// corrections). The two are different things and never carry each other's name.
namespace ensonify::detect {

/// Gain against range that an operator or a maker states: spreading log10 R + 2 alpha R + offset, dB, R in m.
struct RangeLaw {
  double spreading = 40.0;  // 20 for volume, 30 for a seabed cut by the pulse, 40 for a small target
  double absorption_dbpm = 0.0;
  double offset_db = 0.0;
};
double gain_db(const RangeLaw& law, double range_m);

/// Model of the head, the water and the bottom for flattening a seabed image. The bottom is level: a range R
/// is taken to come from the incidence acos(nearest range / R), whatever the beam.
struct FlatteningModel {
  double source_level_db = 220.0;  // rms during the pulse, re 1 uPa at 1 m
  double pulse_length_s = 100e-6;
  double transmit_length_in_waves = 50.76;
  double receive_length_in_waves = 50.76;
  double sound_speed_mps = 1500.0;
  double absorption_dbpm = 0.0;
  double nearest_range_m = 20.0;      // of normal incidence, from earlier detections
  double normal_excess_db = 0.0;      // backscatter at normal incidence over the oblique coefficient: BS_N - BS_O
  double crossover_rad = 0.43633231;  // 25 degrees, where Lambert's law takes over [Hammerstad2000]
};

/// Assumed backscatter strength at a range over the oblique coefficient BS_O, dB: Lambert's 20 log10 cos(incidence)
/// beyond the crossover; from there a straight line in incidence to normal_excess_db at normal incidence
/// [Hammerstad2000]. Nearer than the nearest range it is that of normal incidence.
double assumed_angular_db(const FlatteningModel& model, double range_m);

/// Assumed area that sends echo at a range, dB re 1 m^2: the lesser of the beam's footprint and the pulse's strip.
/// Too large by about 1 dB where the two are equal (near 10 degrees for 1 degree and 100 us in 20 m), by 0.2 dB at
/// nadir and by less than 0.1 dB beyond 35 degrees (docs/physics/acoustics/seabed-image.md).
double assumed_area_db(const FlatteningModel& model, double range_m);

/// First reflectivity field of the Kongsberg kind, "flattened": echo level minus source level, plus 40 log10 R + 2
/// alpha R, minus the assumed area and the assumed angular law. Its mean over a level seabed that obeys the law is
/// BS_O.
double flattened_reflectivity_db(const FlatteningModel& model, double snippet_upa, double range_m);

/// Second reflectivity field, "range law": echo level minus source level, plus the range law alone. What a processor
/// wants who does the area and the angles from true geometry.
double range_law_reflectivity_db(const RangeLaw& law, double source_level_db, double snippet_upa, double range_m);

/// A whole snippet: sample k is at first_range_m + k * range_step_m. Amplitudes below kSilence_upa count as that.
void seabed_image_db(const FlatteningModel& model, std::span<const float> snippet_upa, double first_range_m,
                     double range_step_m, std::span<float> image_db);
void seabed_image_db(const RangeLaw& law, double source_level_db, std::span<const float> snippet_upa,
                     double first_range_m, double range_step_m, std::span<float> image_db);

inline constexpr double kSilence_upa = 1e-6;  // -120 dB: below any receiver's noise, and finite

}  // namespace ensonify::detect
