#include "components/logger/all_settings.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "components/formats/utc.h"
#include "components/logger/em2040.h"

namespace ensonify::logger {

using namespace formats::all;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A transducer's keys: S1X=...,S1R=...
std::string transducer_text(const char* name, const frames::Vec3& position_m,
                            const frames::Quaternion& body_from_head) {
  const frames::Attitude turned = frames::attitude_of(frames::enu_from_ned() * body_from_head);
  return fmt::format("{0}X={1:.4f},{0}Y={2:.4f},{0}Z={3:.4f},{0}H={4:.3f},{0}P={5:.3f},{0}R={6:.3f},{0}S=1,", name,
                     position_m.x() + 0.0, position_m.y() + 0.0, position_m.z() + 0.0,  // no -0
                     frames::wrap_pi(turned.heading_rad) / kDegree + 0.0, turned.pitch_rad / kDegree + 0.0,
                     turned.roll_rad / kDegree + 0.0);
}

}  // namespace

Installation installation(const Vessel& vessel, std::uint16_t serial, const std::string& file_name,
                          const std::string& mark) {
  constexpr const char* kVersion = "0.1.0 250101";
  std::string text = fmt::format("WLZ={:.4f},SMH={},STC=0,", vessel.water_line_m + 0.0, serial);
  text += transducer_text("S1", vessel.transmitter_body_m(), vessel.head.body_from_head);
  text += transducer_text("S2", vessel.receiver_body_m(), vessel.head.body_from_head);
  text += fmt::format("TXS={0},R1S={0},GO1=0.00,", serial);
  for (const char* software : {"TSV", "RSV", "BSV", "PSV", "DSV", "DDS"})
    text += fmt::format("{}={},", software, kVersion);
  text += "OSV=Ensonify,DSX=0.000,DSY=0.000,DSZ=0.000,DSD=0,DSO=0.000000,DSF=1.000000,DSH=NI,";
  for (int system = 1; system <= 3; ++system) {
    text += fmt::format("P{0}M={1},P{0}T=0,P{0}Q=1,P{0}X=0.000,P{0}Y=0.000,P{0}Z=0.000,P{0}D=0.000,P{0}G=WGS84,",
                        system, system == 1 ? 1 : 0);
  }
  text +=
      "P3S=1,MSX=0.000,MSY=0.000,MSZ=0.000,MRP=RP,MSD=0,MSR=0.000,MSP=0.000,MSG=0.000,"
      "NSX=0.000,NSY=0.000,NSZ=0.000,NRP=RP,NSD=0,NSR=0.000,NSP=0.000,NSG=0.000,MAS=1.000,GCG=0.000,"
      "APS=0,AHS=2,ARO=2,AHE=2,CLS=1,CLO=0,PPS=0,VSN=0,VSE=2,VSU=3001,VTE=0,VTU=3000,"
      "VSI=192.168.1.1,VSM=255.255.0.0,";
  text += fmt::format("SID={},RFN={},", mark, file_name);
  return {0, text};
}

Runtime runtime(const msg::AppliedSettings& settings) {
  constexpr std::uint8_t kChirp = 0x20, kReceiver1 = 0x01, kPitchStabilised = 0x80,
                         kYawStabilised = 0x02;  // to the mean heading
  Runtime runtime;
  const bool chirp = is_chirp(settings.pulse);
  runtime.mode = static_cast<std::uint8_t>(frequency_index(settings.frequency_hz) | (chirp ? kChirp : 0));
  runtime.mode_2 = kReceiver1;
  runtime.maximum_depth_m = static_cast<std::uint16_t>(std::min(settings.range_m, 65'534.0));
  runtime.absorption_dbpkm = runtime.absorption_dbpkm.of(1e3 * settings.gain_absorption_dbpm);
  runtime.pulse_length_us = static_cast<std::uint16_t>(std::min(std::round(1e6 * settings.pulse_length_s), 65'534.0));
  runtime.transmit_width_deg = runtime.transmit_width_deg.of(settings.transmit_beamwidth_rad / kDegree);
  runtime.receive_width_deg = runtime.receive_width_deg.of(settings.receive_beamwidth_rad / kDegree);
  const double bandwidth_hz = chirp ? settings.bandwidth_hz : 1.0 / std::max(settings.pulse_length_s, 1e-6);
  runtime.receive_bandwidth_hz = runtime.receive_bandwidth_hz.of(bandwidth_hz);
  const auto half_swath_deg = static_cast<std::uint8_t>(std::round(0.5 * settings.swath_rad / kDegree));
  runtime.maximum_port_deg = runtime.maximum_starboard_deg = half_swath_deg;
  runtime.maximum_port_m = runtime.maximum_starboard_m = runtime.maximum_depth_m;
  runtime.stabilisation = static_cast<std::uint8_t>((settings.pitch_stabilised ? kPitchStabilised : 0) |
                                                    (settings.yaw_stabilised ? kYawStabilised : 0));
  return runtime;
}

SoundSpeedProfile profile(const refraction::SoundSpeedProfile& applied, std::int64_t unix_ns) {
  constexpr double kDeepest_m = 12'000.0;
  constexpr double kStepsPerMetre = 100.0;
  const formats::DayTime time = formats::day_time(unix_ns);
  SoundSpeedProfile profile{.date = time.date, .time_s = time.time_ms / 1'000, .depth_step_cm = 1};
  const auto add = [&](double depth_m) {
    const auto steps = static_cast<std::uint32_t>(std::round(depth_m * kStepsPerMetre));
    if (!profile.nodes.empty() && profile.nodes.back().depth_steps >= steps) return;
    const double speed_mps = applied.speed_mps(depth_m);
    profile.nodes.push_back({steps, formats::FixedPoint<std::uint32_t, 10>::of(speed_mps)});
  };
  add(0.0);
  for (const refraction::Knot& knot : applied.knots()) {
    if (knot.depth_m > 0.0 && knot.depth_m < kDeepest_m) add(knot.depth_m);
  }
  add(kDeepest_m);
  return profile;
}

}  // namespace ensonify::logger
