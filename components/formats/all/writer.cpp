#include "components/formats/all/writer.h"

#include "components/formats/all/frame.h"
#include "components/formats/decode.h"

namespace ensonify::formats::all {

namespace {

char type_of(const Body& body) {
  return std::visit(
      []<class One>(const One&) {
        if constexpr (std::is_same_v<One, Raw>) return '\0';
        else return One::kTypes.front();
      },
      body);
}

}  // namespace

void append(Bytes& out, const Datagram& datagram) {
  const std::size_t begin = out.size();
  LayoutWriter wire(out);
  wire.constant(std::uint32_t{0});  // the length, known below
  wire.constant(std::to_integer<std::uint8_t>(FrameFormat::kStart));
  wire.constant(static_cast<std::uint8_t>(datagram.type));
  wire(datagram.header);
  encode(datagram.body, out);
  out.insert(out.end(), datagram.rest.begin(), datagram.rest.end());

  const bool as_it_is =
      std::holds_alternative<Installation>(datagram.body) || std::holds_alternative<Raw>(datagram.body);
  const std::size_t unpadded = out.size() - begin + FrameFormat::kTrailerBytes;
  if (unpadded % 2 == 1 && datagram.padded && !as_it_is) out.push_back(std::byte{0});
  const ByteView summed = ByteView(out).subspan(begin + FrameFormat::kLengthBytes + 1);
  const std::uint16_t sum = checksum(summed);
  out.push_back(FrameFormat::kEnd);
  append_number(out, sum);
  replace_number(out, begin, static_cast<std::uint32_t>(out.size() - begin - FrameFormat::kLengthBytes));
}

Datagram Writer::datagram(std::int64_t unix_ns, char type, std::uint16_t counter, std::uint16_t serial,
                          Body body) const {
  const DayTime time = day_time(unix_ns);
  return {.type = type, .header = {model_, time.date, time.time_ms, counter, serial}, .body = std::move(body)};
}

void Writer::append_ping(Bytes& out, std::int64_t unix_ns, std::uint16_t ping, std::uint16_t head_serial,
                         Body body) const {
  const char type = type_of(body);
  append(out, datagram(unix_ns, type, ping, head_serial, std::move(body)));
}

void Writer::append_next(Bytes& out, std::int64_t unix_ns, Body body) {
  const char type = type_of(body);
  ENSONIFY_ASSERT(type != 0, "a body of bytes has no type of its own");
  const std::uint16_t counter = ++counters_[static_cast<std::uint8_t>(type)];
  append(out, datagram(unix_ns, type, counter, serial_, std::move(body)));
}

void Writer::append_close(Bytes& out, std::int64_t unix_ns, Installation installation) {
  append(out, datagram(unix_ns, 'i', ++counters_['i'], serial_, std::move(installation)));
}

}  // namespace ensonify::formats::all
