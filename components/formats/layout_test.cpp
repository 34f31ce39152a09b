#include "components/formats/layout.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/formats/utc.h"

using namespace ensonify::formats;

TEST_CASE("a fixed-point quantity is within half a step, and unknown where it does not fit") {
  using Centidegree = FixedPoint<std::int16_t, 100>;
  for (const double value : {-327.68, -0.004, 0.0, 12.346, 327.66}) {
    CHECK(std::abs(Centidegree::of(value).value() - value) <= 0.005 + 1e-12);
  }
  CHECK(std::isnan(Centidegree::of(327.67).value()));  // the count of "not known"
  CHECK(std::isnan(Centidegree::of(-400.0).value()));
  CHECK(std::isnan(Centidegree::of(NAN).value()));
  CHECK(FixedPoint<std::uint16_t, 1, 10>::of(300e3).value() == 300e3);
}

TEST_CASE("a list is not made where the bytes left cannot hold it") {
  const Bytes bytes(10, std::byte{0xFF});
  LayoutReader in(bytes);
  std::vector<std::uint64_t> list;
  in.count(kU32, list);
  CHECK(in.failed());
  CHECK(list.capacity() == 0);
}

TEST_CASE("a list longer than its count can say is a mistake of ours") {
  Bytes bytes;
  LayoutWriter out(bytes);
  CHECK_THROWS_AS(out.count(kU8, std::vector<std::uint8_t>(256)), ensonify::AssertionError);
}

TEST_CASE("dates and times of day come back, across midnight and leap days too") {
  for (const std::uint32_t date : {19700101U, 20240229U, 20251231U, 21000228U}) {
    for (const std::uint32_t time_ms : {0U, 43'200'001U, kDayMs - 1}) {
      const DayTime back = day_time(unix_ns(date, time_ms));
      CHECK(back.date == date);
      CHECK(back.time_ms == time_ms);
    }
  }
  CHECK(unix_ns(20171214, 60'649'381) == 1'513'270'249'381'000'000);
  CHECK_FALSE(is_date(20250229));
  CHECK_FALSE(is_date(20250012));
  CHECK_FALSE(is_date(4294967295U));
}
