#include <catch2/catch.hpp>
#include <random>
#include <string>

#include "components/formats/em_attitude/em_attitude.h"
#include "components/formats/em_attitude/writer.h"
#include "components/formats/km_binary/km_binary.h"
#include "components/formats/km_binary/writer.h"
#include "components/formats/kmall/reader.h"
#include "components/formats/testing/sample.h"
#include "components/formats/tss1/tss1.h"
#include "components/formats/tss1/writer.h"

using namespace ensonify::formats;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

Bytes bytes_of(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

Bytes em_frame(std::uint8_t status, int roll, int pitch, int heave_cm, int heading) {
  Bytes frame;
  append_number(frame, status);
  append_number(frame, std::uint8_t{0x90});
  for (const int value : {roll, pitch, heave_cm, heading}) append_number(frame, static_cast<std::uint16_t>(value));
  return frame;
}

std::vector<std::byte> noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes(count);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

/// Frames that come out of the bytes, given in pieces of a length.
template <class Stream>
std::vector<Bytes> frames_of(ByteView bytes, std::size_t piece) {
  Stream stream;
  std::vector<Bytes> frames;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size()))) {
    stream.take(bytes.first(std::min(piece, bytes.size())),
                [&](ByteView frame) { frames.emplace_back(frame.begin(), frame.end()); });
  }
  return frames;
}

/// Twenty frames, noise, and twenty more: all come out but at most two behind the noise, whatever the pieces.
template <class Stream, class Frame>
void resynchronises(const Frame& frame) {
  for (const std::size_t piece : {1U, 7U, 64U, 100000U}) {
    CAPTURE(piece);
    Bytes sent;
    std::vector<Bytes> wanted;
    const auto send = [&](int from, int to) {
      for (int i = from; i < to; ++i) {
        wanted.push_back(frame(i));
        sent.insert(sent.end(), wanted.back().begin(), wanted.back().end());
      }
    };
    send(0, 20);
    const Bytes garbage = noise(5000, 7);
    sent.insert(sent.end(), garbage.begin(), garbage.end());
    send(20, 40);
    const auto found = frames_of<Stream>(sent, piece);
    REQUIRE(found.size() >= 38);
    REQUIRE(std::equal(found.begin(), found.begin() + 20, wanted.begin()));
    REQUIRE(std::equal(found.end() - 18, found.end(), wanted.end() - 18));
  }
}

}  // namespace

TEST_CASE("a TSS1 line is read: signs, centimetres, hundredths of a degree") {
  const auto sample = *tss1::read(bytes_of(":090048  0013F-0067  0035\r\n"));
  CHECK_THAT(*sample.motion.heave_m, WithinAbs(0.13, 1e-12));
  CHECK_THAT(*sample.motion.roll_rad, WithinAbs(-0.67 * kDegree, 1e-12));
  CHECK_THAT(*sample.motion.pitch_rad, WithinAbs(0.35 * kDegree, 1e-12));
  CHECK(sample.motion.usable);
  CHECK_FALSE(sample.motion.true_heading_rad);
  CHECK_FALSE(sample.motion.time_s);
  CHECK_THAT(sample.horizontal_acceleration_mps2, WithinAbs(9 * 0.0383, 1e-12));
  CHECK_THAT(sample.vertical_acceleration_mps2, WithinAbs(0x48 * 0.000625, 1e-12));
  CHECK_THAT(tss1::read(bytes_of(":09FFFF -0013f 0067 -0035\r\n"))->vertical_acceleration_mps2,
             WithinAbs(-0.000625, 1e-12));
}

TEST_CASE("a TSS1 sensor that is settling is not usable, and what cannot be is no sample") {
  CHECK_FALSE(tss1::read(bytes_of(":090048  0013u-0067  0035\r\n"))->motion.usable);
  for (const char* line :
       {":090048  0013X-0067  0035\r\n", ":09004G  0013F-0067  0035\r\n", ":090048 +0013F-0067  0035\r\n",
        ":090048  00 3F-0067  0035\r\n", ":090048  0013F-0067 -9001\r\n", ":090048  0013F-0067 0035 \r\n", ":090048"}) {
    CAPTURE(line);
    CHECK_FALSE(tss1::read(bytes_of(line)));
  }
}

TEST_CASE("EM 3000 and EM 1000 attitude is read: port up, bow up, heave up") {
  const auto sample = *em_attitude::read(em_frame(0x90, -150, 250, -123, 35999));
  CHECK_THAT(*sample.motion.roll_rad, WithinAbs(-1.5 * kDegree, 1e-12));
  CHECK_THAT(*sample.motion.pitch_rad, WithinAbs(2.5 * kDegree, 1e-12));
  CHECK_THAT(*sample.motion.heave_m, WithinAbs(-1.23, 1e-12));
  CHECK_THAT(*sample.motion.true_heading_rad, WithinAbs(359.99 * kDegree, 1e-12));
  CHECK(sample.motion.usable);
  CHECK(em_attitude::read(em_frame(0x00, 1, 2, 3, 4))->motion.usable);
  CHECK(em_attitude::read(em_frame(0x99, 1, 2, 3, 4))->motion.usable);
  CHECK_FALSE(em_attitude::read(em_frame(0x9A, 1, 2, 3, 4))->motion.usable);
  CHECK_FALSE(em_attitude::read(em_frame(0xAF, 1, 2, 3, 4))->motion.usable);
  CHECK_FALSE(em_attitude::read(em_frame(0xB0, 1, 2, 3, 4)));
  CHECK_FALSE(em_attitude::read(em_frame(0x90, 18001, 2, 3, 4)));
  CHECK_FALSE(em_attitude::read(em_frame(0x90, 1, 2, 1001, 4)));
  CHECK_FALSE(em_attitude::read(em_frame(0x90, 1, 2, 3, 36001)));
}

TEST_CASE("a TSS1 line that is read and written is the same") {
  for (const char* line : {":090048  0013F-0067  0035\r\n", ":09FFFF -0013f 0067 -0035\r\n",
                           ":000000  0000U 0000  0000\r\n", ":FF8000 -9999H-9000  9000\r\n"}) {
    CAPTURE(line);
    CHECK(tss1::write(*tss1::read(bytes_of(line))) == line);
  }
}

TEST_CASE("an EM attitude frame that is read and written is the same") {
  for (const Bytes& frame : {em_frame(0x90, -150, 250, -123, 35999), em_frame(0x00, 18000, -9000, 1000, 0),
                             em_frame(0x9A, -18000, 9000, -1000, 1)}) {
    CHECK(em_attitude::write(*em_attitude::read(frame)) == frame);
  }
}

TEST_CASE("values beyond what TSS1 and EM attitude can say are their limits, and a whole turn is no heading") {
  tss1::Sample line;
  line.status = 'F';
  line.motion = {{}, {}, 2.0, -2.0, 200.0};
  line.horizontal_acceleration_mps2 = 50.0;
  line.vertical_acceleration_mps2 = -50.0;
  CHECK(tss1::write(line) == ":FF8000  9999F 9000 -9000\r\n");
  em_attitude::Sample frame;
  frame.status = 0x90;
  frame.motion = {{}, 359.999 * kDegree, 4.0, -2.0, -12.0};
  CHECK(em_attitude::write(frame) == em_frame(0x90, 18000, -9000, -1000, 0));
}

TEST_CASE("KM binary is read: time of the day, heave up, and only what its status calls valid") {
  km_binary::Sample sent;
  sent.time_s = 1'406'851'200 + 3661;  // 2014-08-01 01:01:01
  sent.time_ns = 250'000'000;
  sent.roll_deg = 1.5F;
  sent.pitch_deg = -2.5F;
  sent.heading_deg = 218.25F;
  sent.heave_m = 0.75F;  // down
  sent.latitude_deg = -22.0;
  sent.longitude_deg = -17.94;
  for (const std::uint16_t length : {120, 132}) {
    sent.stated_bytes = length;
    const auto frames = frames_of<km_binary::Stream>(km_binary::write(sent), 50);
    REQUIRE(frames.size() == 1);
    const auto motion = km_binary::motion_of(*km_binary::read(frames[0]));
    CHECK_THAT(*motion.time_s, WithinAbs(3661.25, 1e-9));
    CHECK_THAT(*motion.roll_rad, WithinAbs(1.5 * kDegree, 1e-9));
    CHECK_THAT(*motion.pitch_rad, WithinAbs(-2.5 * kDegree, 1e-9));
    CHECK_THAT(*motion.true_heading_rad, WithinAbs(218.25 * kDegree, 1e-9));
    CHECK_THAT(*motion.heave_m, WithinAbs(-0.75, 1e-9));
    CHECK(km_binary::place_of(*km_binary::read(frames[0]))->latitude_deg == -22.0);
  }
  sent.status = 0x0F;
  const auto nothing = km_binary::motion_of(sent);
  CHECK((!nothing.roll_rad && !nothing.pitch_rad && !nothing.true_heading_rad && !nothing.heave_m));
  CHECK_FALSE(km_binary::place_of(sent));
  sent.heading_deg = -1.0F;
  CHECK_FALSE(km_binary::read(km_binary::write(sent)));
  sent.heading_deg = 1.0F;
  sent.roll_deg = std::numeric_limits<float>::quiet_NaN();
  CHECK_FALSE(km_binary::read(km_binary::write(sent)));
}

TEST_CASE("samples of a genuine .kmall file, sent alone, are KM binary") {
  const auto path = sample::genuine("records/em2040p_eg.kmall");
  if (!path) {
    WARN("skipped: no data/records/em2040p_eg.kmall in the folder that ENSONIFY_SHARED names");
    return;
  }
  Window file(*path);
  kmall::Reader reader(file);
  std::size_t sent = 0;
  km_binary::Stream stream;
  while (const auto datagram = reader.next()) {
    const auto* motion = std::get_if<kmall::Motion>(&datagram->body);
    if (motion == nullptr) continue;
    for (const auto& one : motion->samples) {
      stream.take(km_binary::write(one), [&](ByteView frame) {
        REQUIRE(*km_binary::read(frame) == one);
        ++sent;
      });
    }
  }
  CHECK(sent > 100);
  CHECK(stream.skipped_bytes() == 0);
}

TEST_CASE("streams find their frames again behind noise, in pieces of any length") {
  SECTION("TSS1") {
    resynchronises<tss1::Stream>(
        [](int i) { return bytes_of(":0900" + std::to_string(10 + i) + "  0013F-0067  0035\r\n"); });
  }
  SECTION("EM 3000") {
    resynchronises<em_attitude::Stream>([](int i) { return em_frame(0x90, 10 * i, -i, i, 100 * i); });
  }
  SECTION("KM binary") {
    resynchronises<km_binary::Stream>([](int i) {
      km_binary::Sample sample;
      sample.time_s = static_cast<std::uint32_t>(i);
      return km_binary::write(sample);
    });
  }
}

TEST_CASE("of noise alone no stream keeps more than two frames, nor takes it for motion") {
  const Bytes garbage = noise(1U << 20U, 3);
  CHECK(frames_of<tss1::Stream>(garbage, 1000).empty());
  CHECK(frames_of<km_binary::Stream>(garbage, 1000).empty());
  CHECK(frames_of<em_attitude::Stream>(garbage, 1000).size() <
        5);  // two in a row by chance: 1e6 (34 / 2^16 * ranges)^2
}
