#include "messages/value.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "messages/fields.h"
#include "messages/health.h"
#include "messages/motion.h"

using namespace ensonify::msg;

TEST_CASE("a path finds members, list elements and nothing else") {
  Pose pose;
  pose.position_enu_m = {1.0, 2.0, 3.0};
  Health health;
  health.counters = {{"late_tile", 4}};
  const Value p = to_value(pose);
  const Value h = to_value(health);

  double number = 0.0;
  REQUIRE(p.at("position_enu_m.2"));
  CHECK(p.at("position_enu_m.2")->number(number));
  CHECK(number == 3.0);
  REQUIRE(h.at("counters.0.count"));
  CHECK(*h.at("counters.0.count") == Value{std::int64_t{4}});
  CHECK(h.at("") == &h);
  CHECK(h.at("counters.1") == nullptr);
  CHECK(h.at("counters.x") == nullptr);
  CHECK(h.at("counters.-1") == nullptr);
  CHECK(h.at("state.0") == nullptr);
  CHECK(h.at("nothing") == nullptr);
}

TEST_CASE("values are compared by their bits") {
  CHECK(Value{NAN} == Value{NAN});
  CHECK(Value{0.0} != Value{-0.0});
  CHECK(Value{std::int64_t{1}} != Value{1.0});
  CHECK(to_value(Array<float>::of({1.0F})) == to_value(Array<float>::of({1.0F})));
  CHECK(to_value(Array<float>::of({1.0F})) != to_value(Array<float>::of({1.5F})));
  CHECK(to_value(Array<float>::of({0.0F})) != to_value(Array<std::int32_t>::of({0})));
  CHECK(to_value(Array<float>({2, 3})) != to_value(Array<float>({3, 2})));
}

TEST_CASE("JSON shows short arrays whole, long ones by range, non-finite numbers as text") {
  CHECK(to_json(to_value(Array<float>::of({1.0F, NAN}))) == R"([1,"nan"])");
  CHECK(to_json(to_value(Array<std::uint8_t>({4, 5}))) == R"({"dtype":"u1","shape":[4,5],"min":0,"max":0})");
  CHECK(to_json(Value{INFINITY}) == R"("inf")");
  CHECK(to_json(Value{0.1}) == "0.1");
  CHECK(to_json(Value{std::string("a\"b\\\n")}) == R"("a\"b\\\n")");
  CHECK(to_json(Value{Value::Map{{"a", {true}}, {"b", Value{Value::List{{}, Value{std::int64_t{-1}}}}}}}) ==
        R"({"a":true,"b":[null,-1]})");
}

TEST_CASE("a value that JSON can say comes back from it, and what is no JSON is refused") {
  const Value value{Value::Map{{"on", Value{true}},
                               {"far", Value{-1.5}},
                               {"count", Value{std::int64_t{7}}},
                               {"all", Value{Value::List{Value{std::string("a")}, Value{Value::Map{}}}}}}};
  CHECK(from_json(to_json(value)) == value);
  CHECK(from_json("18446744073709551615") == Value{std::uint64_t{18446744073709551615U}});
  CHECK_THROWS_AS(from_json("{"), DecodeError);
}
