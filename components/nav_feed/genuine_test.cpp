// The log of a research vessel's receiver drives the vehicle. Where the folder of data is absent, the case says so and
// passes.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "components/nav_feed/testing/feed.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

struct Logged {
  SimTime stamp;
  msg::Position fix;
};

/// Seconds of the hour in "2014-08-01T00:05:01.285000Z".
double arrival_s(const std::string& line) {
  return 60.0 * std::stod(line.substr(14, 2)) + std::stod(line.substr(17, 9));
}

double deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value, squares += value * value;
  const double mean = sum / static_cast<double>(values.size());
  return std::sqrt(squares / static_cast<double>(values.size()) - mean * mean);
}

}  // namespace

TEST_CASE("a vessel's log is followed at its own times: places, and how much she moves") {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  const auto path = std::filesystem::path(shared ? shared : "") / "data/nav/nbp1406_seapath330.nmea";
  if (!shared || !std::filesystem::exists(path)) {
    WARN("skipped: no data/nav/nbp1406_seapath330.nmea in the folder that ENSONIFY_SHARED names");
    return;
  }
  std::map<std::string, int> counts;
  feed::FedBytes feed({}, frames::LocalProjection({-22.0, -17.94}), [&](const std::string& what) { ++counts[what]; });
  std::ifstream log(path);
  std::vector<double> logged_heave_m, heave_m, logged_roll_rad, roll_rad;
  std::vector<std::pair<double, msg::Position>> fixes;
  std::vector<double> motions_at_s;
  const double delay_s = NavFeedConfig{}.delay_s;
  std::size_t met = 0;
  for (std::string line; std::getline(log, line);) {
    const double now_s = arrival_s(line);
    for (; met < motions_at_s.size() && motions_at_s[met] + delay_s <= now_s; ++met) {
      const auto moving = feed.at(from_seconds(motions_at_s[met] + delay_s));
      if (!moving) continue;
      heave_m.push_back(moving->pose.position_enu_m.z());
      roll_rad.push_back(frames::attitude_of(moving->pose.enu_from_body).roll_rad);
    }
    for (; !fixes.empty() && fixes.front().first <= now_s; fixes.erase(fixes.begin())) {
      const auto moving = feed.at(from_seconds(fixes.front().first));
      if (!moving) continue;  // the first ones, on trial until the third
      const auto& logged = fixes.front().second.position_enu_m;
      REQUIRE((moving->pose.position_enu_m.head<2>() - frames::Vec2(logged[0], logged[1])).norm() < 1e-3);
    }
    const std::string_view sentence = std::string_view(line).substr(line.find('$'));
    feed.take(sentence, from_seconds(now_s));
    if (const auto fix = feed.take_fix()) fixes.emplace_back(1e-9 * static_cast<double>(fix->stamp_ns), *fix);
    const auto found = nmea::read_navigation(sentence);
    if (const auto* motion = std::get_if<nmea::Motion>(&found)) {
      motions_at_s.push_back(now_s);  // it has no time of its own
      logged_heave_m.push_back(*motion->heave_m);
      logged_roll_rad.push_back(*motion->roll_rad);
    }
    feed.forget(from_seconds(now_s));
  }
  CHECK(counts["fixes_taken"] == 625);
  CHECK(counts["headings_taken"] == 625);
  CHECK(counts["motions_taken"] == 625);
  CHECK(counts["sentences_late"] == 0);
  CHECK(heave_m.size() > 600);
  CHECK_THAT(deviation(heave_m) / deviation(logged_heave_m), Catch::Matchers::WithinAbs(1.0, 0.01));
  CHECK_THAT(deviation(roll_rad) / deviation(logged_roll_rad), Catch::Matchers::WithinAbs(1.0, 0.01));
}
