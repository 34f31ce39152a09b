#pragma once

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "components/formats/window.h"
#include "components/logger/node.h"
#include "components/runtime/testing/node_under_test.h"
#include "scenarios/world/world.h"

/// A survey over a flat seabed, for tests: what a logger reads of it.
namespace ensonify::logger::testing {

inline constexpr double kReferenceDepth_m = 0.7;  // of the vessel, at rest
inline constexpr double kSeabedDepth_m = 20.0;
inline constexpr double kSoundSpeed_mps = 1490.0;
inline constexpr std::size_t kBeams = 101;  // a degree apart; every tenth has no sounding
inline constexpr SimTime kPingPeriod = 137_ms;

/// A folder of this test program, gone at its end.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ensonify_logger_test_" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

/// Far from the north pole, with a boat whose head "bow" is turned about all axes.
World bay();
LoggerConfig config_of(const World& world, const char* text = "{}");

/// The vessel rolls, pitches and heaves on its way to the north-east, far enough from the origin to feel the
/// convergence.
double heave_up_m(SimTime t);
frames::Pose pose_at(SimTime t);

void give_navigation(NodeUnderTest<LoggerNode>& logger, SimTime until);

/// Soundings on the flat seabed; every tenth beam has none.
msg::Soundings ping_at(SimTime t, std::int64_t number, const frames::Mounting& mounting);

inline constexpr std::size_t kColumnSamples = 601;  // the last is one too many for an even number
inline constexpr double kColumnPeriod_s = 5e-5;
inline constexpr double kSourceLevel_db = 210.0;

/// The datagrams of a file, which has no faults.
template <class Datagram, class Reader>
std::vector<Datagram> read(const std::filesystem::path& path) {
  REQUIRE(std::filesystem::exists(path));
  formats::Window window(path);
  Reader reader(window);
  std::vector<Datagram> datagrams;
  while (auto datagram = reader.next()) datagrams.push_back(std::move(*datagram));
  REQUIRE(reader.faults().count() == 0);
  return datagrams;
}

/// The water column of a ping: in beam b a level of 100 + b / 10 dB re 1 uPa, 60 dB more where the bottom is.
msg::Ping column_of(const msg::Soundings& soundings);

/// Ten seconds of survey, pings from the start on, every third with a water column where that is logged; the files lie
/// in `folder`.
void survey(const World& world, const char* text, const std::filesystem::path& folder);

}  // namespace ensonify::logger::testing
