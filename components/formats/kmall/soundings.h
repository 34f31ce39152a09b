#pragma once

#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

#include "components/formats/kmall/header.h"

namespace ensonify::formats::kmall {

/// How a ping was made: settings in force, and where the vessel was at its first pulse.
struct PingInfo {
  std::uint16_t padding_0 = 0;
  float ping_rate_hz = 0;
  std::uint8_t beam_spacing = 0;
  std::uint8_t depth_mode = 0;  // + 100: chosen by hand
  std::uint8_t sub_depth_mode = 0;
  std::uint8_t swath_distance = 0;
  std::uint8_t detection_mode = 0;  // + 100: simulator
  std::uint8_t pulse_form = 0;
  std::uint16_t padding_1 = 0;
  float frequency_mode_hz = 0;  // below 100: a code
  float lowest_hz = 0;
  float highest_hz = 0;
  float longest_pulse_s = 0;
  float longest_effective_pulse_s = 0;
  float widest_effective_bandwidth_hz = 0;
  float absorption_dbpkm = 0;
  float port_edge_deg = 0;
  float starboard_edge_deg = 0;
  float port_coverage_deg = 0;
  float starboard_coverage_deg = 0;
  std::int16_t port_coverage_m = 0;
  std::int16_t starboard_coverage_m = 0;
  std::uint8_t stabilisation = 0;
  std::uint8_t filter_1 = 0;
  std::uint16_t filter_2 = 0;
  std::uint32_t pipe_tracking = 0;
  float transmit_array_deg = 0;
  float receive_array_deg = 0;
  float transmit_power_db = 0;  // re maximum
  std::uint16_t ramp_up_s = 0;
  std::uint16_t padding_2 = 0;
  float yaw_angle_deg = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.padding_0, self.ping_rate_hz, self.beam_spacing, self.depth_mode, self.sub_depth_mode,
         self.swath_distance, self.detection_mode, self.pulse_form, self.padding_1, self.frequency_mode_hz,
         self.lowest_hz, self.highest_hz, self.longest_pulse_s, self.longest_effective_pulse_s,
         self.widest_effective_bandwidth_hz, self.absorption_dbpkm, self.port_edge_deg, self.starboard_edge_deg,
         self.port_coverage_deg, self.starboard_coverage_deg, self.port_coverage_m, self.starboard_coverage_m,
         self.stabilisation, self.filter_1, self.filter_2, self.pipe_tracking, self.transmit_array_deg,
         self.receive_array_deg, self.transmit_power_db, self.ramp_up_s, self.padding_2, self.yaw_angle_deg);
  }
  bool operator==(const PingInfo&) const = default;
};

/// The vessel at the first pulse of a ping.
struct PingPose {
  float heading_deg = 0;
  float sound_speed_mps = 0;     // at the transducer
  float transducer_depth_m = 0;  // transmitter below the water line
  float water_line_m = 0;        // z of the water line from the reference point, down
  float x_to_all_m = 0;          // from the reference point to that of .all files, forward
  float y_to_all_m = 0;          // to starboard
  std::uint8_t position_info = 0;
  std::uint8_t position_status = 0;
  std::uint8_t attitude_status = 0;
  std::uint8_t padding = 0;
  double latitude_deg = 200;  // of the reference point; 200: not known
  double longitude_deg = 200;
  float ellipsoid_height_m = 0;
  float backscatter_offset_db = 0;
  std::uint8_t lambert_removed = 0;
  std::uint8_t ice_window = 0;
  std::uint16_t active_modes = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.heading_deg, self.sound_speed_mps, self.transducer_depth_m, self.water_line_m, self.x_to_all_m,
         self.y_to_all_m, self.position_info, self.position_status, self.attitude_status, self.padding,
         self.latitude_deg, self.longitude_deg, self.ellipsoid_height_m, self.backscatter_offset_db,
         self.lambert_removed, self.ice_window, self.active_modes);
  }
  bool operator==(const PingPose&) const = default;
};

/// A sounding with what it was made of.
struct Sounding {
  std::uint16_t index = 0;
  std::uint8_t sector = 0;
  std::uint8_t detection = 0;  // 0 normal, 1 extra, 2 rejected
  std::uint8_t method = 0;     // 1 amplitude, 2 phase, 0 neither
  std::uint8_t rejection_1 = 0;
  std::uint8_t rejection_2 = 0;
  std::uint8_t post_processing = 0;
  std::uint8_t detection_class = 0;
  std::uint8_t confidence = 0;
  std::uint16_t padding = 0;
  float range_factor = 0;
  float quality = 0;  // % of depth
  float vertical_sd_m = 0;
  float horizontal_sd_m = 0;
  float window_s = 0;
  float echo_length_s = 0;
  std::uint16_t water_column_beam = 0;
  std::uint16_t water_column_range = 0;  // samples
  float water_column_angle_deg = 0;
  float absorption_dbpkm = 0;
  float reflectivity_1_db = 0;  // with a flat bottom's TVG
  float reflectivity_2_db = 0;  // with that of the sonar equation
  float sensitivity_db = 0;
  float source_level_db = 0;
  float calibration_db = 0;
  float tvg_db = 0;
  float angle_deg = 0;  // re the receive array, to port
  float angle_correction_deg = 0;
  float travel_time_s = 0;  // two-way
  float travel_time_correction_s = 0;
  float delta_latitude_deg = 0;  // from the reference point
  float delta_longitude_deg = 0;
  float z_m = 0;  // down from the reference point
  float y_m = 0;  // to starboard
  float x_m = 0;  // forward
  float incidence_adjustment_deg = 0;
  std::uint16_t cleaning = 0;
  std::uint16_t image_first_sample = 0;
  std::uint16_t image_centre_sample = 0;
  std::uint16_t image_samples = 0;

  bool valid() const { return detection < 2; }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.index, self.sector, self.detection, self.method, self.rejection_1, self.rejection_2, self.post_processing,
         self.detection_class, self.confidence, self.padding, self.range_factor, self.quality, self.vertical_sd_m,
         self.horizontal_sd_m, self.window_s, self.echo_length_s, self.water_column_beam, self.water_column_range,
         self.water_column_angle_deg, self.absorption_dbpkm, self.reflectivity_1_db, self.reflectivity_2_db,
         self.sensitivity_db, self.source_level_db, self.calibration_db, self.tvg_db);
    wire(self.angle_deg, self.angle_correction_deg, self.travel_time_s, self.travel_time_correction_s,
         self.delta_latitude_deg, self.delta_longitude_deg, self.z_m, self.y_m, self.x_m, self.incidence_adjustment_deg,
         self.cleaning, self.image_first_sample, self.image_centre_sample, self.image_samples);
  }
  bool operator==(const Sounding&) const = default;
};

/// A ping of one head: settings, pose, sectors, soundings, seabed image.
struct Soundings {
  static constexpr std::string_view kType = "#MRZ";
  static constexpr std::uint8_t kVersion = 3;
  struct Sector {
    std::uint8_t number = 0;
    std::uint8_t array = 0;
    std::uint8_t sub_array = 0;
    std::uint8_t padding_0 = 0;
    float delay_s = 0;
    float tilt_deg = 0;
    float source_level_db = 0;
    float focus_m = 0;
    float centre_hz = 0;
    float bandwidth_hz = 0;
    float pulse_length_s = 0;
    std::uint8_t shading = 0;
    std::uint8_t waveform = 0;  // 0 CW, 1 FM up, 2 FM down
    std::uint16_t padding_1 = 0;
    float high_voltage_db = 0;
    float tracking_db = 0;
    float effective_length_s = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.number, self.array, self.sub_array, self.padding_0, self.delay_s, self.tilt_deg, self.source_level_db,
           self.focus_m, self.centre_hz, self.bandwidth_hz, self.pulse_length_s, self.shading, self.waveform,
           self.padding_1, self.high_voltage_db, self.tracking_db, self.effective_length_s);
    }
    bool operator==(const Sector&) const = default;
  };
  struct ExtraClass {
    std::uint16_t detections = 0;
    std::uint8_t padding = 0;
    std::uint8_t alarm = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.detections, self.padding, self.alarm);
    }
    bool operator==(const ExtraClass&) const = default;
  };
  Partition partition;
  PingPart ping;
  PingInfo info;
  PingPose pose;
  std::vector<Sector> sectors;
  std::uint16_t main_soundings = 0;  // of the soundings; the others are extra detections
  std::uint16_t valid_main_soundings = 0;
  float water_column_hz = 0;
  float image_hz = 0;
  float normal_incidence_strength_db = 0;
  float oblique_strength_db = 0;
  std::uint16_t extra_alarm = 0;
  std::uint16_t extra_soundings = 0;
  std::vector<ExtraClass> classes;
  std::vector<Sounding> soundings;
  std::vector<std::int16_t> image_ddb;  // tenths of a decibel, of one sounding after the other

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.partition, self.ping);
    wire.constant(kInfoBytes);
    wire(self.info);
    wire.count(kU16, self.sectors);
    wire.constant(static_cast<std::uint16_t>(fixed_bytes<Sector>()));
    wire(self.pose);
    wire.each(self.sectors);
    wire.constant(kReceiveBytes);
    wire(self.main_soundings, self.valid_main_soundings);
    wire.constant(static_cast<std::uint16_t>(fixed_bytes<Sounding>()));
    wire(self.water_column_hz, self.image_hz, self.normal_incidence_strength_db, self.oblique_strength_db,
         self.extra_alarm, self.extra_soundings);
    wire.count(kU16, self.classes);
    wire.constant(static_cast<std::uint16_t>(fixed_bytes<ExtraClass>()));
    wire.each(self.classes);
    wire.resize(self.soundings, std::uint64_t{self.main_soundings} + self.extra_soundings);
    wire.each(self.soundings);
    wire.resize(self.image_ddb, image_samples(self.soundings));
    wire.each(self.image_ddb);
  }
  bool operator==(const Soundings&) const = default;

  static constexpr std::uint16_t kInfoBytes = 152;
  static constexpr std::uint16_t kReceiveBytes = 32;
  static std::uint64_t image_samples(const std::vector<Sounding>& soundings) {
    return std::accumulate(soundings.begin(), soundings.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const Sounding& one) { return sum + one.image_samples; });
  }
};

}  // namespace ensonify::formats::kmall
