#include "tools/console/survey.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "messages/motion.h"
#include "messages/navigation.h"

using namespace ensonify;
using namespace ensonify::console;
using Catch::Matchers::WithinAbs;

namespace {

template <msg::Message M>
msg::Packet packet_of(const std::string& topic, const M& message, std::uint32_t epoch = 1) {
  msg::Packet packet{topic, {}, msg::encode(message), {}};
  packet.envelope.epoch = epoch;
  return packet;
}

struct Place {
  double east_m, north_m, depth_m;
  int valid = 1;
};

void ping(Survey& survey, const std::vector<Place>& places, std::uint32_t epoch = 1) {
  msg::Soundings soundings;
  soundings.valid = msg::Array<std::uint8_t>({places.size()});
  soundings.position_enu_m = msg::Array<double>({places.size(), 3});
  for (std::size_t i = 0; i < places.size(); ++i) {
    soundings.valid[i] = static_cast<std::uint8_t>(places[i].valid);
    soundings.position_enu_m(i, 0) = places[i].east_m;
    soundings.position_enu_m(i, 1) = places[i].north_m;
    soundings.position_enu_m(i, 2) = -places[i].depth_m;
  }
  survey.take("soundings/1", packet_of("bow/soundings", soundings, epoch));
}

}  // namespace

TEST_CASE("cells hold what fell into them, and a viewer gets those that changed") {
  Survey survey;
  Survey::Seen seen;
  CHECK_FALSE(survey.new_cells(seen));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ping(survey, {{0.1, 0.1, 20.0}, {0.2, 0.3, 21.0}, {-0.1, 0.2, 22.0}, {50.0, 50.0, 23.0, 0}, {nan, 0.0, 5.0}});
  const auto first = survey.new_cells(seen);
  REQUIRE(first);
  CHECK(first->cell_m == 0.5);  // a fiftieth of 21 m, rounded up
  REQUIRE(first->count.size() == 2);
  CHECK(first->column[0] == -1);
  CHECK(first->column[1] == 0);
  CHECK(first->count[1] == 2);
  CHECK_THAT(first->mean_depth_m[1], WithinAbs(20.5, 1e-5));
  CHECK_THAT(first->shoalest_depth_m[1], WithinAbs(20.0, 1e-5));
  CHECK_THAT(first->sd_m[1], WithinAbs(std::sqrt(0.5), 1e-5));
  CHECK(std::isnan(first->sd_m[0]));
  CHECK_FALSE(survey.new_cells(seen));

  ping(survey, {{100.0, 100.0, 20.0}});
  const auto second = survey.new_cells(seen);
  REQUIRE(second);
  CHECK(second->count.size() == 1);
  Survey::Seen late;
  CHECK(survey.new_cells(late)->count.size() == 3);  // who comes later gets all
}

TEST_CASE("a large grid comes in several messages, nothing twice and nothing left out") {
  Survey survey;
  for (int i = 0; i < 1000; ++i) ping(survey, {{10.0 * i + 0.1, 0.1, 20.0}, {10.0 * i + 0.1, 500.1, 20.0}});
  Survey::Seen seen;
  std::size_t cells = 0, messages = 0;
  while (const auto fresh = survey.new_cells(seen)) {
    cells += fresh->count.size();
    ++messages;
  }
  CHECK(cells == 2000);
  CHECK(messages == 7);  // 300 blocks each
}

TEST_CASE("tracks grow by points half a metre apart; the newest position is always there") {
  Survey survey;
  msg::Pose pose;
  for (int i = 0; i < 21; ++i) {
    pose.stamp_ns = i;
    pose.position_enu_m = {0.1 * i, 0.0, -2.0};
    pose.enu_from_body = {0.0, std::sqrt(0.5), std::sqrt(0.5), 0.0};  // level, to the north
    survey.take("pose/1", packet_of("boat/pose", pose));
  }
  Survey::Seen seen;
  const auto tracks = survey.new_tracks(seen);
  REQUIRE(tracks.size() == 1);
  CHECK(tracks[0].truth);
  CHECK(tracks[0].point_enu_m.rows() == 5);
  CHECK(tracks[0].stamp_ns == 20);
  CHECK_THAT(std::cos(tracks[0].heading_rad), WithinAbs(1.0, 1e-9));
  CHECK(survey.new_tracks(seen)[0].point_enu_m.empty());
  CHECK(survey.new_tracks(seen)[0].first == 5);
}

TEST_CASE("another epoch begins with nothing") {
  Survey survey;
  ping(survey, {{0.1, 0.1, 20.0}});
  Survey::Seen seen;
  const auto before = survey.new_cells(seen);
  ping(survey, {{5.1, 0.1, 20.0}}, 2);
  const auto after = survey.new_cells(seen);
  REQUIRE(after);
  CHECK(after->generation == before->generation + 1);
  CHECK(after->count.size() == 1);
}

TEST_CASE("cells suit the depth") {
  CHECK(cell_for(3.0) == Approx(0.1));
  CHECK(cell_for(10.0) == Approx(0.2));
  CHECK(cell_for(25.0) == Approx(0.5));
  CHECK(cell_for(26.0) == Approx(1.0));
  CHECK(cell_for(2400.0) == Approx(50.0));
}
