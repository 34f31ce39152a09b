#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/formats/bytes.h"
#include "components/logger/moment.h"
#include "messages/soundings.h"

namespace ensonify::logger {

/// What a file begins with.
struct FileStart {
  std::int64_t unix_ns = 0;  // of its first moment
  std::string name;
  frames::Geodetic place;                // of the reference point
  const msg::AppliedSettings& settings;  // of its first ping
};

/// A multibeam's ping as it is logged.
struct LoggedSoundings {
  const msg::Soundings& soundings;
  const std::optional<msg::SeabedImage>& image;
  const std::optional<msg::Ping>& water_column;
  std::int64_t unix_ns = 0;
  double heave_down_m = 0.0;
  const frames::LocalProjection& world;
};

/// A sidescan's ping: its transmissions by frequency, as declared.
struct SidescanPing {
  std::vector<msg::Ping> transmissions;
  std::optional<double> altitude_m;  // by its own echoes
};
struct LoggedSidescan {
  const SidescanPing& ping;
  std::int64_t unix_ns = 0;
  double heave_down_m = 0.0;
  const frames::LocalProjection& world;
};

/// Soundings and what belongs to them, or the water column, which stands in files of its own.
enum class Part { kSoundings, kWaterColumn };

/// One of the formats that a survey is written in: what it appends to its file, whole datagrams each time. A file is
/// begun, gets moments and pings in their order, and is ended; then the next may begin.
class Format {
 public:
  virtual ~Format() = default;
  virtual std::string ending() const = 0;  // of its files' names: ".all"
  virtual void begin(const FileStart& start, formats::Bytes& out) = 0;
  virtual void moment(const Moment& moment, formats::Bytes& out) = 0;
  virtual void ping(const LoggedSoundings& /*ping*/, formats::Bytes& /*out*/) {}
  virtual void ping(const LoggedSidescan& /*ping*/, formats::Bytes& /*out*/) {}
  virtual void end(formats::Bytes& out) = 0;
};

}  // namespace ensonify::logger
