// Arbitrary bytes as a record of each format: readers skip what is broken, and what they give is written again as it
// was.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "components/formats/all/network.h"
#include "components/formats/all/reader.h"
#include "components/formats/all/writer.h"
#include "components/formats/kmall/parts.h"
#include "components/formats/kmall/reader.h"
#include "components/formats/kmall/writer.h"
#include "components/formats/recognise.h"
#include "components/formats/xtf/reader.h"
#include "components/formats/xtf/writer.h"

using namespace ensonify::formats;

namespace {

void must_stand_in(ByteView file, std::uint64_t offset, const Bytes& written) {
  if (offset > file.size() || written.size() > file.size() - offset) std::abort();
  if (!std::equal(written.begin(), written.end(), file.begin() + static_cast<std::ptrdiff_t>(offset))) std::abort();
}

template <class Reader, class Append>
void read_and_write(ByteView bytes, Append&& append) {
  Window file(bytes);
  Reader reader(file);
  std::uint64_t given = 0;
  while (const auto one = reader.next()) {
    Bytes written;
    append(written, *one);
    must_stand_in(bytes, one->offset, written);
    given += written.size();
  }
  if (reader.faults().skipped_bytes() + given > bytes.size()) std::abort();
}

/// The same bytes as what came of a network, one datagram after the other by the lengths that stand before them: what
/// is given is a whole datagram of a file, and no longer than all that came.
void receive(ByteView bytes) {
  kmall::PartJoiner joiner;
  std::size_t came = 0;
  while (bytes.size() >= 2) {
    const std::size_t length = std::min<std::size_t>(ByteSource(bytes).number<std::uint16_t>(), bytes.size() - 2);
    const ByteView datagram = bytes.subspan(2, length);
    bytes = bytes.subspan(2 + length);
    came += length;
    if (const auto whole = all::from_network(datagram)) {
      if (whole->size() != length + 4) std::abort();
      must_stand_in(datagram, 0, Bytes(all::to_network(*whole).begin(), all::to_network(*whole).end()));
    }
    if (const auto whole = joiner.take(datagram)) {
      if (whole->size() > came) std::abort();
      Window file{ByteView(*whole)};
      if (kmall::FrameFormat::check(file, 0).bytes != whole->size()) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteView bytes = std::as_bytes(std::span(data, size));
  Window file(bytes);
  recognise(file);
  read_and_write<all::Reader>(bytes, [](Bytes& out, const all::Datagram& datagram) { all::append(out, datagram); });
  read_and_write<kmall::Reader>(bytes,
                                [](Bytes& out, const kmall::Datagram& datagram) { kmall::append(out, datagram); });
  read_and_write<xtf::Reader>(bytes, [](Bytes& out, const xtf::Packet& packet) { xtf::append(out, packet); });
  receive(bytes);
  return 0;
}
