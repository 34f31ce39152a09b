#pragma once

#include <cstddef>
#include <optional>

#include "components/formats/bytes.h"

namespace ensonify::formats::all {

/// Bytes of the datagram at the front of a file's bytes, by its length. The bytes are our own.
std::size_t datagram_bytes(ByteView file);

/// A datagram as the network carries it: from its start mark on, without the length that stands before it in a file.
ByteView to_network(ByteView datagram);

/// What came of the network as a file has it. Nothing where it is no whole datagram: marks, date and checksum are those
/// that a reader of files asks for.
std::optional<Bytes> from_network(ByteView received);

}  // namespace ensonify::formats::all
