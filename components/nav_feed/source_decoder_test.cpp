#include "components/nav_feed/source_decoder.h"

#include <catch2/catch.hpp>
#include <map>

#include "components/nav_feed/testing/feed.h"

using namespace ensonify;
using namespace feed;
using Catch::WithinAbs;

namespace {

struct Decoded {
  std::vector<nmea::Navigation> said;
  std::map<std::string, int> counts;

  template <class Sentence>
  const Sentence& as(std::size_t i) const {
    return std::get<Sentence>(said.at(i));
  }
};

/// The bytes in pieces of a length; 0: as one datagram.
Decoded decoded(const FeedSource& source, std::string_view bytes, std::size_t piece = 0) {
  Decoded found;
  SourceDecoder decoder(source, [&](const std::string& what) { ++found.counts[what]; });
  const auto keep = [&](const nmea::Navigation& said) { found.said.push_back(said); };
  if (piece == 0) decoder.take(bytes, false, true, keep);
  for (; piece > 0 && !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) {
    decoder.take(bytes.substr(0, piece), false, false, keep);
  }
  return found;
}

}  // namespace

TEST_CASE("sentences are whole again, whatever the pieces that a connection brings them in") {
  const std::string text = fix(100.0, 1.0, 2.0) + heading(45.0) + motion_sentence(100.0, 1.0, 0.5);
  for (const std::size_t piece : {1U, 3U, 50U, 1000U}) CHECK(decoded({}, text, piece).said.size() == 3);
  CHECK(decoded({}, text.substr(0, text.size() - 2)).said.size() == 3);      // a datagram ends its last one
  CHECK(decoded({}, text.substr(0, text.size() - 2), 50).said.size() == 2);  // a connection may go on with it
}

TEST_CASE("a line of a megabyte is left out and counted, and the next one is read") {
  const auto found = decoded({}, "$" + std::string(1U << 20U, 'x') + "\r\n" + heading(45.0), 60000);
  CHECK(found.said.size() == 1);
  CHECK(found.counts.at("lines_too_long") == 1);
}

TEST_CASE("a connection that breaks leaves no half sentence to the next one") {
  FeedSource source;
  int malformed = 0, headings = 0;
  SourceDecoder decoder(source, [](const std::string&) {});
  const auto look = [&](const nmea::Navigation& said) {
    malformed += std::holds_alternative<nmea::Malformed>(said);
    headings += std::holds_alternative<nmea::Heading>(said);
  };
  decoder.take("$HEHDT,12", true, false, look);
  decoder.take(heading(45.0), true, false, look);
  CHECK(malformed == 0);
  CHECK(headings == 1);
}

TEST_CASE("signs are turned where the source has the others") {
  FeedSource source;
  source.roll_reversed = source.heave_reversed = true;
  const auto motion = decoded(source, motion_sentence(100.0, 1.0, 0.5)).as<formats::Motion>(0);
  CHECK_THAT(*motion.roll_rad, WithinAbs(-kDegree, 1e-12));
  CHECK_THAT(*motion.heave_m, WithinAbs(-0.5, 1e-12));
}

TEST_CASE("GPS time is brought to UTC, across midnight too; without a scale times are not used") {
  FeedSource source;
  source.time_scale = FeedSource::TimeScale::kGps;
  CHECK(decoded(source, fix(118.0, 0, 0)).as<nmea::Fix>(0).time_s == 100.0);
  CHECK(decoded(source, fix(8.0, 0, 0)).as<nmea::Fix>(0).time_s == 86390.0);
  CHECK(*decoded(source, motion_sentence(118.0, 0, 0)).as<formats::Motion>(0).time_s == 100.0);
  const auto clock = decoded(source, nmea::sentence("GPZDA,000008.00,02,08,2014,,")).as<nmea::DateAndTime>(0);
  CHECK(clock.time_s == 86390.0);
  CHECK(clock.date == std::chrono::sys_days(std::chrono::year(2014) / 8 / 1));
  source.time_scale = FeedSource::TimeScale::kNone;
  CHECK_FALSE(decoded(source, motion_sentence(118.0, 0, 0)).as<formats::Motion>(0).time_s);
}

TEST_CASE("heave of a sensor off the reference point is less what it rises by as the body turns") {
  FeedSource source;
  source.heave_body_m = {0.0, 4.0, -2.0};  // to starboard, which goes down with a positive roll
  const auto motion = decoded(source, motion_sentence(100.0, 10.0, 0.5)).as<formats::Motion>(0);
  const double rises_m = -4.0 * std::sin(10.0 * kDegree) + 2.0 * std::cos(10.0 * kDegree) - 2.0;
  CHECK_THAT(*motion.heave_m, WithinAbs(0.5 - rises_m, 1e-9));
}

TEST_CASE("what a source is not asked for is left out and counted") {
  FeedSource source;
  source.place = source.heading = false;
  const auto found = decoded(source, fix(100.0, 0, 0) + heading(45.0) + motion_sentence(100.0, 1.0, 0.5));
  REQUIRE(found.said.size() == 1);
  CHECK_FALSE(found.as<formats::Motion>(0).true_heading_rad);
  CHECK(found.counts.at("sentences_not_asked_for") == 2);
  source.heading = true;
  source.motion = false;
  const auto heading_alone = decoded(source, motion_sentence(100.0, 1.0, 0.5)).as<formats::Motion>(0);
  CHECK(heading_alone.true_heading_rad);
  CHECK_FALSE(heading_alone.roll_rad);
}

TEST_CASE("TSS1 lines of a sensor that is settling are counted, not taken") {
  FeedSource source;
  source.format = FeedSource::Format::kTss1;
  const auto found =
      decoded(source, ":090048  0013F-0067  0035\r\n:090048  0013f-0067  0035\r\n:090048  0013X-0067  0035\r\n", 5);
  REQUIRE(found.said.size() == 1);
  CHECK_THAT(*found.as<formats::Motion>(0).heave_m, WithinAbs(0.13, 1e-12));
  CHECK(found.counts.at("motions_invalid") == 1);
  CHECK(found.counts.at("motions_malformed") == 1);
}
