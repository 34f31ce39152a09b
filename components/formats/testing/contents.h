#pragma once

#include <vector>

#include "components/formats/fault.h"
#include "components/formats/window.h"

namespace ensonify::formats::sample {

/// All that a reader gives of a file.
template <class Datagram>
struct Contents {
  std::vector<Datagram> datagrams;
  Faults faults;
};

template <class Datagram, class Reader>
Contents<Datagram> contents_of(Window& file) {
  Reader reader(file);
  Contents<Datagram> contents;
  while (auto datagram = reader.next()) contents.datagrams.push_back(std::move(*datagram));
  contents.faults = reader.faults();
  return contents;
}

}  // namespace ensonify::formats::sample
