#include "messages/codec.h"

#include <catch2/catch.hpp>
#include <limits>

#include "messages/all.h"

using namespace ensonify;
using namespace ensonify::msg;
using namespace std::string_literals;

namespace {

/// A struct with a member of every kind.
struct Sample {
  bool flag = false;
  std::int32_t small = 0;
  std::uint64_t large = 0;
  double number = 0.0;
  std::string text;
  std::array<double, 3> fixed{};
  std::vector<Counter> list;
  Array<float> image;
  Array<std::uint8_t> mask;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("flag", "", "", self.flag);
    visit("small", "", "", self.small);
    visit("large", "", "", self.large);
    visit("number", "", "", self.number);
    visit("text", "", "", self.text);
    visit("fixed", "", "", self.fixed);
    visit("list", "", "", self.list);
    visit("image", "", "", self.image);
    visit("mask", "", "", self.mask);
  }
};

Sample sample() {
  Sample s;
  s.flag = true;
  s.small = -7;
  s.large = std::numeric_limits<std::uint64_t>::max();
  s.number = -0.1;
  s.text = "line \"3\"\n\xC3\xA9";
  s.fixed = {1.5, 0.0, -1e300};
  s.list = {{"late_tile", 2}, {"gap", 0}};
  s.image = Array<float>({2, 3});
  for (std::size_t i = 0; i < 6; ++i) s.image[i] = static_cast<float>(i) - 2.5F;
  s.mask = Array<std::uint8_t>::of({1, 0, 255});
  return s;
}

void check_equal(const Sample& a, const Sample& b) { CHECK(to_value(a) == to_value(b)); }

Body body(std::string map, std::vector<std::string> arrays = {}) {
  Body made{Buffer::own(std::move(map)), {}};
  for (std::string& array : arrays) made.arrays.push_back(Buffer::own(std::move(array)));
  return made;
}

/// msgpack: short text, small map and list heads.
std::string text(const std::string& s) { return static_cast<char>(0xA0 + s.size()) + s; }
std::string map(int entries) { return {static_cast<char>(0x80 + entries)}; }
std::string list(int entries) { return {static_cast<char>(0x90 + entries)}; }
std::string descriptor(const std::string& dtype, const std::string& shape, int frame = 3) {
  return map(3) + text("dtype") + text(dtype) + text("shape") + shape + text("frame") + static_cast<char>(frame);
}
std::string image(const std::string& array) { return map(1) + text("image") + array; }

std::string refusal(const Body& message, std::size_t max_bytes = 1 << 20) {
  try {
    decode<Sample>(message, max_bytes);
  } catch (const DecodeError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a message comes back as it was sent") {
  const Sample sent = sample();
  const Body bytes = encode(sent);
  REQUIRE(bytes.arrays.size() == 2);
  CHECK(bytes.arrays[0].size == 24);
  check_equal(decode<Sample>(bytes, bytes.size()), sent);
}

TEST_CASE("arrays are sent and received without a copy") {
  const Sample sent = sample();
  const Body bytes = encode(sent);
  CHECK(bytes.arrays[0].data == reinterpret_cast<const std::byte*>(sent.image.data()));
  CHECK(decode<Sample>(bytes, bytes.size()).image.data() == sent.image.data());
}

TEST_CASE("an array whose frame starts at an odd address is copied, not misread") {
  Sample sent = sample();
  Body bytes = encode(sent);
  std::string shifted(1 + bytes.arrays[0].size, '\0');
  std::memcpy(shifted.data() + 1, bytes.arrays[0].data, bytes.arrays[0].size);
  Buffer whole = Buffer::own(std::move(shifted));
  bytes.arrays[0] = {whole.owner, whole.data + 1, whole.size - 1};
  check_equal(decode<Sample>(bytes, bytes.size()), sent);
}

TEST_CASE("a record's payload holds the arrays and gives the same message") {
  const Sample sent = sample();
  const Body frames = encode(sent);
  const Buffer payload = encode_inline(frames);
  CHECK(decode_inline(payload) == decode_value(frames, frames.size()));
  Sample read;
  from_value(decode_inline(payload), read, "");
  check_equal(read, sent);
}

TEST_CASE("every message type survives the trip with its defaults") {
  for_each_message([](const auto& message) {
    using M = std::remove_cvref_t<decltype(message)>;
    INFO(M::kType);
    const Body bytes = encode(message);
    CHECK(to_value(decode<M>(bytes, bytes.size())) == to_value(message));
    CHECK(decode_inline(encode_inline(bytes)) == to_value(message));
  });
}

TEST_CASE("NaN, infinities and empty arrays travel unchanged") {
  Sample sent;
  sent.number = std::numeric_limits<double>::quiet_NaN();
  sent.fixed = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), -0.0};
  sent.image = Array<float>({4, 0});
  const Body bytes = encode(sent);
  const Sample read = decode<Sample>(bytes, bytes.size());
  check_equal(read, sent);
  CHECK(read.image.shape() == std::vector<std::size_t>{4, 0});
  CHECK(read.image.empty());
}

TEST_CASE("unknown keys are ignored and missing ones keep their default") {
  Sample expected;
  expected.small = 5;
  check_equal(decode<Sample>(body(map(2) + text("small") + "\x05" + text("novelty") + list(2) + "\x01\x02"), 100),
              expected);
}

TEST_CASE("integers are range-checked, and any number serves as a float") {
  CHECK(decode<Sample>(body(map(1) + text("number") + "\x05"), 100).number == 5.0);
  CHECK(refusal(body(map(1) + text("small") + "\xCE\xFF\xFF\xFF\xFF")) == "small: is not an integer in range");
  CHECK(refusal(body(map(1) + text("large") + "\xFF")) == "large: is not an integer in range");
  CHECK(refusal(body(map(1) + text("small") + "\xCA\x3F\x80\x00\x00"s)) == "small: is not an integer in range");
}

TEST_CASE("what is not the declared kind is refused by field name") {
  CHECK(refusal(body(map(1) + text("flag") + "\x01")) == "flag: is not a boolean");
  CHECK(refusal(body(map(1) + text("number") + text("12"))) == "number: is not a number");
  CHECK(refusal(body(map(1) + text("text") + "\xC0")) == "text: is not text");
  CHECK(refusal(body(map(1) + text("fixed") + list(2) + "\x01\x02")) == "fixed: is not a list of the declared length");
  CHECK(refusal(body(map(1) + text("list") + map(0))) == "list: is not a list");
  CHECK(refusal(body(map(1) + text("list") + list(1) + "\x01")) == "list.0: is not a map");
  CHECK(refusal(body(map(1) + text("list") + list(1) + map(1) + text("count") + "\xC2")) ==
        "list.0.count: is not an integer in range");
  CHECK(refusal(body(image(descriptor("f8", list(1) + "\x01")), {std::string(8, '\0')})) == "image: is not f4");
}

TEST_CASE("an array must be what its descriptor says") {
  const std::string bytes(8, '\0');
  CHECK(refusal(body(image(descriptor("f4", list(1) + "\x02")), {bytes})) == "accepted");
  CHECK(refusal(body(image(descriptor("f3", list(1) + "\x02")), {bytes})) == "message image: unknown dtype");
  CHECK(refusal(body(image(descriptor("f4", "\x02")), {bytes})) == "message image: has no shape");
  CHECK(refusal(body(image(descriptor("f4", list(1) + "\xFF")), {bytes})) == "message image: bad shape");
  CHECK(refusal(body(image(descriptor("f4", list(2) + "\xCB" + std::string(8, '\x7F') + "\x01")), {bytes})) ==
        "message image: bad shape");
  const std::string huge = "\xCF\x40" + std::string(7, '\0');  // 2^62, whose product with 2^62 overflows
  CHECK(refusal(body(image(descriptor("f4", list(2) + huge + huge)), {bytes})) == "message image: bad shape");
  CHECK(refusal(body(image(descriptor("f4", list(1) + "\x03")), {bytes})) ==
        "message image: shape asks for 12 bytes, the frame has 8");
  CHECK(refusal(body(image(descriptor("f4", list(1) + "\x02", 4)), {bytes})) == "message image: has no such frame");
  CHECK(refusal(body(image(descriptor("f4", list(1) + "\x02", 2)), {bytes})) == "message image: has no such frame");
}

TEST_CASE("two arrays cannot share a frame, or a record would grow without bound") {
  const std::string array = descriptor("f4", list(1) + "\x02");
  CHECK(refusal(body(map(2) + text("image") + array + text("mask") + array, {std::string(8, '\0')})) ==
        "message mask: has no such frame");
}

TEST_CASE("malformed maps are refused") {
  CHECK(refusal(body("")) == "message is empty");
  CHECK(refusal(body("\x01")) == "message is not a map");
  CHECK(refusal(body(list(0))) == "message is not a map");
  CHECK_THAT(refusal(body("\xC1")), Catch::StartsWith("message is not msgpack"));
  CHECK(refusal(body(map(0) + "\x01")) == "message has 1 bytes too many");
  CHECK(refusal(body(map(1) + "\x01\x01")) == "message a map key is not text");
  CHECK(refusal(body(map(1) + map(0) + "\x01")) == "message a map key is not text");
  CHECK(refusal(body(map(2) + text("a") + "\x01" + text("a") + "\x01")) == "message a: stands twice");
  CHECK(refusal(body(map(1) + text("a") + "\xD4\x01\x01")) == "message holds a msgpack extension type");
}

TEST_CASE("every truncation of a message is refused") {
  const Body whole = encode(sample());
  for (std::size_t size = 0; size < whole.map.size; ++size) {
    Body cut = whole;
    cut.map.size = size;
    INFO(size);
    CHECK_THROWS_AS(decode<Sample>(cut, 1 << 20), DecodeError);
  }
  Body cut = whole;
  cut.arrays.pop_back();
  CHECK(refusal(cut) == "message mask: has no such frame");
}

TEST_CASE("a message larger than declared is refused before it is looked at") {
  const Body bytes = encode(sample());
  CHECK(refusal(bytes, bytes.size()) == "accepted");
  CHECK_THAT(refusal(bytes, bytes.size() - 1), Catch::EndsWith("were declared"));
  CHECK(refusal(body(std::string(kMaxMapBytes + 1, '\0')), 1 << 24) == "message map is larger than 1 MiB");
}

TEST_CASE("depth, values and keys are bounded, whatever the counts in the message promise") {
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += map(1) + text("a");
  CHECK(refusal(body(deep + "\x01")) == "message is nested deeper than 16");

  const std::string promise = "\xDD\xFF\xFF\xFF\xFF";  // a list of four billion
  CHECK_THAT(refusal(body(map(1) + text("a") + promise)), Catch::StartsWith("message ends early"));

  const std::string many = "\xDC\xFF\xFF" + std::string(0xFFFF, '\x01');
  CHECK(refusal(body(map(1) + text("a") + many)) == "message has more than 16384 values");

  std::string keys = "\xDE\x04\x00"s;  // 1024 keys
  for (int i = 0; i < 1024; ++i) keys += text(std::to_string(i)) + "\x01";
  CHECK(refusal(body(keys)) == "message has a map of more than 512 keys");
}
