// Casts measured at sea, against straight-forward answers computed elsewhere (shared data,
// ssp/expected_refraction.csv).
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "kernels/water/refraction/eigenray.h"
#include "kernels/water/refraction/path_table.h"

using namespace ensonify::refraction;
using Catch::Matchers::WithinAbs;

/// Lines of two numbers, depth and speed: the body of .asvp, .vel and .svp files. Sorted, equal depths averaged.
static SoundSpeedProfile read_cast(const std::filesystem::path& file) {
  std::vector<Knot> samples, knots;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Knot knot{};
    if (words >> knot.depth_m >> knot.speed_mps && (words >> std::ws).eof()) samples.push_back(knot);
  }
  std::ranges::stable_sort(samples, {}, &Knot::depth_m);
  for (std::size_t i = 0, end = 0; i < samples.size(); i = end) {
    double sum = 0;
    for (end = i; end < samples.size() && samples[end].depth_m == samples[i].depth_m; ++end)
      sum += samples[end].speed_mps;
    knots.push_back({samples[i].depth_m, sum / static_cast<double>(end - i)});
  }
  return SoundSpeedProfile(knots);
}

TEST_CASE("through real casts time and distance are those computed elsewhere") {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  const auto folder = std::filesystem::path(shared ? shared : "") / "data/ssp";
  if (!std::filesystem::exists(folder / "expected_refraction.csv")) {
    WARN("skipped: no data/ssp/expected_refraction.csv in the folder that ENSONIFY_SHARED names");
    return;
  }
  std::ifstream table(folder / "expected_refraction.csv");
  std::string line;
  std::getline(table, line);
  int answers = 0;
  while (std::getline(table, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::string file;
    double source, bottom, speed, nadir, time, across;
    REQUIRE(words >> file >> source >> bottom >> speed >> nadir >> time >> across);
    if (!file.ends_with(".asvp") && !file.ends_with(".vel") && !file.ends_with(".svp")) continue;
    INFO(line);
    const SoundSpeedProfile cast = read_cast(folder / file);
    const double depression = (90 - nadir) * std::numbers::pi / 180;
    const auto end = path_to_depth(cast, source, depression, bottom);
    REQUIRE(end);
    CHECK_THAT(end->travel_time_s, WithinAbs(time, 6e-10));  // printed to 1 ns
    CHECK_THAT(end->horizontal_m, WithinAbs(across, 6e-5));  // and 0.1 mm
    PathTable paths;
    paths.build(cast, source, bottom - 3);
    CHECK(paths.at(depression, bottom)->travel_time_s == Approx(time).epsilon(1e-6));
    CHECK_THAT(paths.at(depression, bottom)->horizontal_m, WithinAbs(across, 1e-3));
    ++answers;
  }
  CHECK(answers == 25);
}
