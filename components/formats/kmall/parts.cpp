#include "components/formats/kmall/parts.h"

#include <algorithm>
#include <string_view>

#include "components/errors/assert.h"
#include "components/formats/kmall/frame.h"
#include "components/formats/kmall/header.h"

namespace ensonify::formats::kmall {

namespace {

constexpr std::size_t kLengthBytes = FrameFormat::kLengthBytes;
constexpr std::size_t kHeadBytes = FrameFormat::kHeadBytes;
constexpr std::size_t kPartitionBytes = 4;
constexpr std::size_t kAround = kHeadBytes + kPartitionBytes + kLengthBytes;  // a part's piece of the body

bool has_partition(ByteView datagram) {
  const std::string_view type(reinterpret_cast<const char*>(datagram.data()) + kLengthBytes, FrameFormat::kTypeBytes);
  return datagram.size() >= kAround && (type == "#MRZ" || type == "#MWC");
}

Partition partition_of(ByteView datagram) {
  Partition partition;
  LayoutReader in(datagram.subspan(kHeadBytes, kPartitionBytes));
  in(partition);
  return partition;
}

ByteView piece_of(ByteView part) { return part.subspan(kHeadBytes + kPartitionBytes, part.size() - kAround); }

void append(Bytes& out, ByteView bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

/// A frame with the head of another (its length is replaced), and a piece of the body that the caller appends.
template <class AppendBody>
Bytes framed(ByteView head, Partition partition, AppendBody&& append_body) {
  Bytes out(head.begin(), head.end());
  LayoutWriter wire(out);
  wire(partition);
  append_body(out);
  const auto length = static_cast<std::uint32_t>(out.size() + kLengthBytes);
  wire.constant(length);
  replace_number(out, 0, length);
  return out;
}

}  // namespace

std::size_t datagram_bytes(ByteView file) {
  const std::size_t bytes = ByteSource(file).number<std::uint32_t>();
  ENSONIFY_ASSERT(bytes >= FrameFormat::kLeastLength && bytes <= file.size(),
                  std::to_string(bytes) + " bytes of " + std::to_string(file.size()));
  return bytes;
}

std::vector<Bytes> parts_of(ByteView datagram) {
  if (datagram.size() <= kMostPartBytes || !has_partition(datagram)) return {Bytes(datagram.begin(), datagram.end())};
  constexpr std::size_t kPiece = kMostPartBytes - kAround;
  const ByteView body = piece_of(datagram);
  const std::size_t count = (body.size() + kPiece - 1) / kPiece;
  std::vector<Bytes> parts;
  for (std::size_t i = 0; i < count; ++i) {
    const Partition partition{static_cast<std::uint16_t>(count), static_cast<std::uint16_t>(i + 1)};
    parts.push_back(framed(datagram.first(kHeadBytes), partition, [&](Bytes& out) {
      append(out, body.subspan(i * kPiece, std::min(kPiece, body.size() - i * kPiece)));
    }));
  }
  return parts;
}

PartJoiner::Head PartJoiner::head_of(ByteView received) {
  Head head{};
  std::copy(received.begin() + kLengthBytes, received.begin() + kHeadBytes, head.begin());
  return head;
}

/// Whether this part came already.
bool PartJoiner::has(const Open& open, std::size_t part, ByteView received) const {
  return open.head == head_of(received) && part < open.parts.size() &&
         std::equal(open.parts[part].begin(), open.parts[part].end(), received.begin(), received.end());
}

Bytes PartJoiner::joined(const Open& open) const {
  return framed(ByteView(open.parts.front()).first(kHeadBytes), Partition{}, [&](Bytes& out) {
    for (const Bytes& part : open.parts) append(out, piece_of(part));
  });
}

std::optional<Bytes> PartJoiner::take(ByteView received) {
  Window frame{received};
  if (received.empty() || FrameFormat::check(frame, 0).bytes != received.size()) {
    ++counts_.refused;
    return std::nullopt;
  }
  const Partition partition = has_partition(received) ? partition_of(received) : Partition{};
  if (partition.parts < 1 || partition.parts > kMostParts || partition.part < 1 || partition.part > partition.parts) {
    ++counts_.refused;
    return std::nullopt;
  }
  if (partition.parts == 1) {
    ++counts_.whole;
    return Bytes(received.begin(), received.end());
  }
  const std::size_t part = partition.part - 1U;
  if (last_ && has(*last_, part, received)) {
    ++counts_.doubled;
    return std::nullopt;
  }
  auto open = std::find_if(open_.begin(), open_.end(), [&](const Open& one) {
    return one.head == head_of(received) && one.parts.size() == partition.parts;
  });
  if (open != open_.end() && has(*open, part, received)) {
    ++counts_.doubled;
    return std::nullopt;
  }
  if (open != open_.end() && !open->parts[part].empty()) {
    ++counts_.incomplete;
    open_.erase(open);
    open = open_.end();
  }
  if (open == open_.end()) {
    if (open_.size() == kMostOpen) {
      ++counts_.incomplete;
      open_.pop_front();
    }
    open_.push_back({head_of(received), std::vector<Bytes>(partition.parts), partition.parts});
    open = std::prev(open_.end());
  }
  open->parts[part].assign(received.begin(), received.end());
  if (--open->missing > 0) return std::nullopt;
  last_ = std::move(*open);
  open_.erase(open);
  ++counts_.whole;
  return joined(*last_);
}

void PartJoiner::finish() {
  counts_.incomplete += static_cast<std::int64_t>(open_.size());
  open_.clear();
}

}  // namespace ensonify::formats::kmall
