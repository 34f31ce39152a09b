#include "components/formats/kmall/writer.h"

#include "components/formats/decode.h"

namespace ensonify::formats::kmall {

void append(Bytes& out, const Datagram& datagram) {
  const std::size_t begin = out.size();
  LayoutWriter wire(out);
  wire.constant(std::uint32_t{0});  // the length, known below
  ENSONIFY_ASSERT(datagram.type.size() == 4, "\"" + datagram.type + "\" is no type of four characters");
  wire.rest(datagram.type);
  wire(datagram.header);
  encode(datagram.body, out);
  out.insert(out.end(), datagram.rest.begin(), datagram.rest.end());
  const auto length = static_cast<std::uint32_t>(out.size() - begin + sizeof(std::uint32_t));
  wire.constant(length);
  replace_number(out, begin, length);
}

void Writer::append_body(Bytes& out, std::int64_t unix_ns, Body body) const {
  Datagram datagram;
  std::visit(
      [&]<class One>(const One&) {
        if constexpr (!std::is_same_v<One, Raw>) {
          datagram.type = One::kType;
          datagram.header.version = One::kVersion;
        }
      },
      body);
  datagram.header.system = system_;
  datagram.header.sounder = sounder_;
  datagram.header.time_s = static_cast<std::uint32_t>(unix_ns / 1'000'000'000);
  datagram.header.time_ns = static_cast<std::uint32_t>(unix_ns % 1'000'000'000);
  datagram.body = std::move(body);
  append(out, datagram);
}

}  // namespace ensonify::formats::kmall
