#include "components/logger/kmall/installation.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "components/logger/em2040.h"

namespace ensonify::logger::kmall {

using namespace formats::kmall;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Lever arm from where an array is installed to its phase centre, in the array's own frame.
std::string arm_text(const char* name, const frames::Vec3& arm_m) {
  return fmt::format(";{0}X={1:.5f};{0}Y={2:.5f};{0}Z={3:.5f}", name, arm_m.x() + 0.0, arm_m.y() + 0.0,
                     arm_m.z() + 0.0);  // no -0
}

/// An array's group up to its lever arms: place and angles.
std::string array_text(const char* name, std::uint16_t serial, const frames::Vec3& position_m,
                       const frames::Mounting& head) {
  const frames::Attitude turned = frames::attitude_of(frames::enu_from_ned() * head.body_from_head);
  return fmt::format("{}:N={};X={:.4f};Y={:.4f};Z={:.4f};R={:.3f};P={:.3f};H={:.3f};S=1.0", name, serial,
                     position_m.x() + 0.0, position_m.y() + 0.0, position_m.z() + 0.0, turned.roll_rad / kDegree + 0.0,
                     turned.pitch_rad / kDegree + 0.0, frames::wrap_pi(turned.heading_rad) / kDegree + 0.0);
}

int frequency_khz(double frequency_hz) { return 200 + 100 * frequency_index(frequency_hz); }

const char* on_off(bool on) { return on ? "On" : "Off"; }

}  // namespace

Installation installation(const Vessel& vessel, std::uint16_t serial, const std::string& mark) {
  const frames::Vec3 transmitter_m = vessel.transmitter_body_m(), receiver_m = vessel.receiver_body_m();
  const frames::Quaternion head_from_body = vessel.head.body_from_head.conjugate();
  const frames::Vec3 transmit_arm_m = head_from_body * (vessel.head.position_body_m - transmitter_m);
  const frames::Vec3 receive_arm_m = head_from_body * (vessel.head.position_body_m - receiver_m);

  Installation installation;
  std::string& text = installation.text;
  text = fmt::format("OSCV:{},EMXV:EM2040,\nPU_0,\n", mark);
  text += fmt::format("SN={},\nIP=192.168.1.1:0xffff0000,\nUDP=1997,\nTYPE=CON_TECH_PP_B12_SMP_CPU,\n", serial);
  text += "VERSIONS:,\nCPU:0.1.0 2025-01-01,\nVERSIONS-END,\n";
  text += fmt::format("SERIALno:\nTX:{0},\nRX:{0},\nSERIALno-END,\n", serial);
  text += "DCL:0.1.0 2025-01-01,\nKMALL:Rev I 2021-06-04,\nSYSTEM:EM 2040 - Single Tx single Rx,";
  // The head has one transmit array: whichever of the three a reader takes, it comes to the head's origin.
  text += array_text("TRAI_TX1", serial, transmitter_m, vessel.head);
  for (const char* array : {"IP", "IC", "IS"}) text += arm_text(array, transmit_arm_m);
  text += "," + array_text("TRAI_RX1", serial, receiver_m, vessel.head) + arm_text("IR", receive_arm_m);
  text +=
      ",POSI_1:X=0.000;Y=0.000;Z=0.000;D=0.000;G=WGS84;T=Datagram;C=On;F=GGA;Q=On;I=Serial port 1;U=ACTIVE,"
      "POSI_2:U=NOT_SET,POSI_3:U=NOT_SET,"
      "ATTI_1:X=0.000;Y=0.000;Z=0.000;R=0.000;P=0.000;H=0.000;D=0.000;M=Rotation;F=KM Binary;I=Serial port 2;U=ACTIVE,"
      "ATTI_2:U=NOT_SET,CLCK:F=ZDA;S=CLK;A=On rising edge;I=Serial port 1;Q=OK,DPHI:U=NOT_SET,"
      "SVPI:F=AML NMEA;I=Integrated probe;U=ACTIVE,";
  text += fmt::format("EMXI:SWLZ={:.4f},\n", vessel.water_line_m + 0.0);
  return installation;
}

Runtime runtime(const msg::AppliedSettings& settings, bool simulator) {
  const double half_swath_deg = 0.5 * settings.swath_rad / kDegree;
  Runtime runtime;
  std::string& text = runtime.text;
  text = fmt::format(
      "\nSector coverage\nMax angle Port: {0:9.1f}\nMax angle Starboard: {0:.1f}\nMax coverage Port: {1:10.1f}\n"
      "Max coverage Starboard: {1:.1f}\nAngular coverage Mode: Manual\nSector mode: Normal\n",
      half_swath_deg, settings.range_m);
  text += fmt::format(
      "\nDepth settings\nForced depth: --\nMin. depth: 1.0\nMax. depth: {:.1f}\nDual swath: Off\nDepth mode: Shallow\n"
      "Frequency: {}kHz\nDetector mode: Normal\nFM disable: {}\nWater column data: On\n",
      settings.range_m, frequency_khz(settings.frequency_hz), on_off(!is_chirp(settings.pulse)));
  text += fmt::format(
      "\nTransmit Control\nPitch stabilisation: {}\nTransmit angle Along: 0.0\nMax. Ping Freq. (Hz): {:.1f}\n"
      "Min. Swath Dist.: 0.0\nExternal Trigger: Off\n\nYaw Stabilisation Mode: {}\n",
      on_off(settings.pitch_stabilised), settings.ping_rate_hz, settings.yaw_stabilised ? "Rel. mean heading" : "Off");
  text +=
      "\nSound velocity at Transducer\nSound Velocity source: Probe\nSensor Offset: 0.0\nFilter: 0.0\n"
      "\nFiltering\nSpike filter strength: Off\nRange gate size: Normal\nPhase ramp: Normal\n"
      "Penetration Filter Strength: Off\nSpecial TVG: Off\nSlope: Off\nAeration: Off\nInterference: Off\n"
      "Special amp detection: Off\n";
  text += fmt::format("\nAbsorption Coefficient\nSource: Manual\n{}kHz: {:.3f}\n", frequency_khz(settings.frequency_hz),
                      1e3 * settings.gain_absorption_dbpm);
  text += "\nTX Power\nTransmit power level: 0 dB\n\nSpecial Mode\nSonar mode: Off\nPassive: Off\n";
  text += fmt::format("\nSimulation setup\nEnable Simulation: {}\n\nScope Display\nScope display enabled: Off\n\n",
                      on_off(simulator));
  return runtime;
}

SoundSpeedProfile profile(const refraction::SoundSpeedProfile& applied, std::int64_t unix_ns,
                          const frames::Geodetic& place) {
  constexpr double kDeepest_m = 12'000.0;
  constexpr float kNotKnown = -9'999.0F;
  SoundSpeedProfile profile{.time_s = static_cast<std::uint32_t>(unix_ns / 1'000'000'000),
                            .latitude_deg = place.latitude_deg,
                            .longitude_deg = place.longitude_deg};
  const auto add = [&](double depth_m) {
    const auto depth = static_cast<float>(depth_m);
    if (!profile.nodes.empty() && profile.nodes.back().depth_m >= depth) return;
    profile.nodes.push_back({depth, static_cast<float>(applied.speed_mps(depth_m)), 0, kNotKnown, kNotKnown});
  };
  add(0.0);
  for (const refraction::Knot& knot : applied.knots()) {
    if (knot.depth_m > 0.0 && knot.depth_m < kDeepest_m) add(knot.depth_m);
  }
  add(kDeepest_m);
  return profile;
}

}  // namespace ensonify::logger::kmall
