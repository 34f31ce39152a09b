#include "components/formats/nmea/steering.h"

#include <catch2/catch.hpp>
#include <string>

#include "components/formats/nmea/testing/sentence.h"

using namespace ensonify::nmea;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

template <class T>
bool is(const Steer& found) {
  return std::holds_alternative<T>(found);
}
LegOrder leg(const char* body) { return std::get<LegOrder>(read_steering(sentence(body))); }

}  // namespace

TEST_CASE("sentences as plotters send them are read") {
  // Examples of gpsd's page of NMEA sentences.
  const auto apb = std::get<LegOrder>(read_steering("$GPAPB,A,A,0.10,R,N,V,V,011,M,DEST,011,M,011,M*3C"));
  CHECK(apb.off_m == Approx(-185.2));  // steer to starboard: it is to port of the leg
  CHECK(apb.leg->rad == Approx(11 * kDegree));
  CHECK(apb.leg->magnetic);
  const auto xte = std::get<LegOrder>(read_steering("$GPXTE,A,A,0.67,L,N*6F"));
  CHECK(xte.off_m == Approx(0.67 * 1852));
  CHECK_FALSE(xte.leg);
  const auto rmb =
      std::get<LegOrder>(read_steering("$GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,001.3,052.5,000.5,V*20"));
  CHECK(rmb.off_m == Approx(0.66 * 1852));
  CHECK(rmb.to_end_m == Approx(1.3 * 1852));
  CHECK(rmb.to_end->rad == Approx(52.5 * kDegree));
  CHECK_FALSE(rmb.to_end->magnetic);
  const auto hsc = std::get<HeadingOrder>(read_steering(sentence("IIHSC,40.5,T,42.1,M")));
  CHECK(hsc.heading.rad == Approx(40.5 * kDegree));
  CHECK_FALSE(hsc.heading.magnetic);
  CHECK(std::get<HeadingOrder>(read_steering(sentence("IIHSC,,T,42.1,M"))).heading.magnetic);
}

TEST_CASE("kilometres are a unit too") { CHECK(leg("GPXTE,A,A,0.05,L,K").off_m == Approx(50.0)); }

TEST_CASE("what its source warns of is not taken") {
  for (const char* body :
       {"GPAPB,V,A,0.10,R,N,V,V,011,T,DEST,011,T,011,T", "GPAPB,A,V,0.10,R,N,V,V,011,T,D,011,T,011,T",
        "GPAPB,A,A,0.10,R,N,V,V,011,T,D,011,T,011,T,N", "GPXTE,V,A,0.67,L,N", "GPXTE,A,A,0.67,L,N,N",
        "GPRMB,V,0.66,L,003,004,4917.24,N,12309.57,W,001.3,052.5,000.5,V"}) {
    CAPTURE(body);
    CHECK(is<Warned>(read_steering(sentence(body))));
  }
}

TEST_CASE("a source that knows nothing yet is not a broken one") {
  CHECK(is<Empty>(read_steering(sentence("IIHSC,,T,,M"))));
  CHECK(is<Empty>(read_steering(sentence("GPXTE,A,A,,,N"))));
  CHECK(is<Empty>(read_steering(sentence("GPRMB,A,,,,,,,,,,,,V"))));
}

TEST_CASE("sentences that cannot be are malformed") {
  for (const char* body :
       {"IIHSC,361,T", "IIHSC,40.5,X", "IIHSC,nan,T", "IIHSC", "GPXTE,A,A,0.67,X,N", "GPXTE,A,A,0.67,L,F",
        "GPXTE,A,A,-1,L,N", "GPXTE,A,A,0.67", "GPAPB,A,A,0.10,R,N,V,V,400,T,D", "GPAPB,A,A,0.1,R,N",
        "GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,-1,052.5,000.5,V", "GPRMB,A,0.66,L"}) {
    CAPTURE(body);
    CHECK(is<Malformed>(read_steering(sentence(body))));
  }
  CHECK(is<BadChecksum>(read_steering("$GPXTE,A,A,0.67,L,N*6E")));
  CHECK(is<Other>(read_steering(sentence("INHDT,218.26,T"))));
}
