#pragma once

#include <cstdint>
#include <variant>

#include "components/formats/all/header.h"
#include "components/formats/all/image.h"
#include "components/formats/all/installation.h"
#include "components/formats/all/navigation.h"
#include "components/formats/all/sound_speed.h"
#include "components/formats/all/soundings.h"
#include "components/formats/all/water_column.h"
#include "components/formats/raw.h"
#include "components/formats/utc.h"

namespace ensonify::formats::all {

using Body = std::variant<Raw, Installation, Runtime, Position, Height, Attitude, NetworkAttitude, Clock,
                          SoundSpeedProfile, SurfaceSoundSpeed, RawRangeAngle, Soundings, SeabedImage, WaterColumn>;

struct Datagram {
  std::uint64_t offset = 0;  // in its file, of the length
  char type = 0;             // as the specification prints it: 'X'
  Header header;
  Body body;
  Bytes rest;          // behind what the layout knows; empty in every file seen
  bool padded = true;  // with a zero where the length would be odd; of 'I', 'i' and Raw the bytes stay as they are

  std::int64_t unix_ns() const { return formats::unix_ns(header.date, header.time_ms); }
};

}  // namespace ensonify::formats::all
