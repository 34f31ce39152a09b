#pragma once

#include "components/formats/xtf/file_header.h"
#include "components/formats/xtf/packet.h"

namespace ensonify::formats::xtf {

/// Most samples a channel may have in one ping, in bytes: beyond them readers in wide use fail.
inline constexpr std::size_t kMostSampleBytes = 16'384;

void append(Bytes& out, const FileHeader& header);

/// Appends a packet in its frame: magic number, length, padding.
void append(Bytes& out, const Packet& packet);

/// A packet of this body: its type, and how many channels follow.
Packet packet_of(Body body);

}  // namespace ensonify::formats::xtf
