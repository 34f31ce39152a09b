#include "components/steering_feed/ordered_course.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>

#include "components/formats/nmea/testing/sentence.h"
#include "kernels/base/frames/attitude.h"

using namespace ensonify;
using nmea::sentence;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

struct Feed {
  explicit Feed(const SteeringFeedConfig& config = {})
      : course(config, [this](const std::string& what) { ++counts[what]; }) {}

  void take(const std::string& body, SimTime now = 0_s) { course.take(sentence(body), now); }
  double heading_deg(SimTime now = 0_s) {
    const auto order = course.order(now, 2.0);
    return order ? order->true_rad / kDegree : NAN;
  }

  std::map<std::string, int> counts;
  OrderedCourse course;
};

}  // namespace

TEST_CASE("a heading ordered is steered while its sentence counts") {
  Feed feed;
  CHECK(std::isnan(feed.heading_deg()));
  feed.take("IIHSC,40.5,T,42.1,M", 10_s);
  CHECK(feed.heading_deg(13_s) == Approx(40.5));
  CHECK(feed.course.order(13_s, 2.0)->is_heading);
  CHECK(std::isnan(feed.heading_deg(13_s + 100_ms)));
  CHECK(std::isnan(feed.heading_deg(13_s)));  // it is gone for good
}

TEST_CASE("a leg is come to from the side on which the vehicle is, and the more the longer") {
  Feed feed;
  feed.take("GPAPB,A,A,0.005,L,N,V,V,090,T,W1,090,T,090,T");  // 9.26 m to starboard of a leg to the east
  const double first_deg = feed.heading_deg();
  CHECK(first_deg < 90.0 - std::atan(9.26 / 24.0) / kDegree + 0.5);  // the lookahead at 2 m/s is ten lags: 24 m
  CHECK(first_deg > 45.0);
  for (int i = 0; i < 50; ++i) feed.heading_deg();
  CHECK(feed.heading_deg() < first_deg);
  feed.take("GPAPB,A,A,0.000,R,N,V,V,180,T,W2,180,T,180,T");  // another leg forgets that
  CHECK(feed.heading_deg() == Approx(180.0));
}

TEST_CASE("RMB and APB of the same leg agree") {
  Feed apb, rmb;
  apb.take("GPAPB,A,A,0.100,R,N,V,V,020,T,W1,020,T,020,T");
  // 185.2 m to port of the leg, 1852 m from its end: the end bears asin(0.1) to starboard of the leg.
  rmb.take("GPRMB,A,0.100,R,W0,W1,4917.24,N,12309.57,W,1.000,25.739,000.5,V");
  CHECK(apb.heading_deg() == Approx(rmb.heading_deg()).margin(1e-3));
}

TEST_CASE("XTE alone needs a leg that is known") {
  Feed feed;
  feed.take("GPXTE,A,A,0.010,L,N");
  CHECK(feed.counts["legs_without_a_bearing"] == 1);
  feed.take("GPAPB,A,A,0.000,R,N,V,V,045,T,W1,045,T,045,T");
  CHECK(feed.heading_deg() == Approx(45.0));
  feed.take("GPXTE,A,A,0.010,L,N");
  CHECK(feed.heading_deg() < 40.0);
}

TEST_CASE("magnetic bearings need the variation") {
  Feed without;
  without.take("IIHSC,,T,40.0,M");
  CHECK(without.counts["bearings_without_variation"] == 1);
  CHECK(std::isnan(without.heading_deg()));
  SteeringFeedConfig config;
  config.variation_rad = -3.0 * kDegree;  // west
  Feed with(config);
  with.take("IIHSC,,T,40.0,M");
  CHECK(with.heading_deg() == Approx(37.0));
}

TEST_CASE("what is wrong is counted, and orders nothing") {
  Feed feed;
  feed.take("GPXTE,V,A,0.010,L,N");
  feed.take("IIHSC,,T,,M");
  feed.take("IIHSC,400,T");
  feed.take("IIHDT,40,T");
  feed.course.take("$IIHSC,40.5,T*00\r\n\r\n", 0_s);
  CHECK(feed.counts == std::map<std::string, int>{{"sentences_not_valid", 1},
                                                  {"sentences_without_data", 1},
                                                  {"sentences_malformed", 1},
                                                  {"sentences_of_other_kinds", 1},
                                                  {"sentences_with_bad_checksum", 1}});
  CHECK(std::isnan(feed.heading_deg()));
}
