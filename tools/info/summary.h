#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/formats/fault.h"

/// What `ensonify info` says of a file, whatever its format.
namespace ensonify::info {

/// Lowest and highest of some values; of none while empty().
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool empty() const { return low > high; }
  void add(double value);  // NaN and infinities are left out
};

/// Extent of positions. East may be less than west: the antimeridian lies between.
class Extent {
 public:
  /// 0, 0 and what is no position are counted apart.
  void add(double latitude_deg, double longitude_deg);
  bool empty() const { return latitude_deg_.empty(); }
  const Range& latitude_deg() const { return latitude_deg_; }
  double west_deg() const;
  double east_deg() const;
  std::uint64_t unusable() const { return unusable_; }

 private:
  Range latitude_deg_;
  Range unwrapped_deg_;  // longitudes, from the first one on
  double first_deg_ = 0;
  std::uint64_t unusable_ = 0;
};

/// Values of one kind by time.
struct Stream {
  std::uint64_t count = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::int64_t longest_gap_ns = 0;
  std::int64_t gap_begin_ns = 0;
  std::uint64_t backward = 0;  // times before that of the value before, of the same sensor

  void add(std::int64_t time_ns, int sensor = 0);
  /// Values of a sensor a second, in the mean of the sensors; 0 of fewer than two.
  double rate_hz() const;

 private:
  std::map<int, std::int64_t> newest_ns_;  // by sensor
};

/// Pings of one head by their numbers, which are modulo 65536 in .all and .kmall.
class Pings {
 public:
  struct Gap {
    std::uint64_t first = 0;  // number that is not there, as the file would have it, and how many from it on
    std::uint64_t count = 0;
    std::int64_t after_ns = 0;  // time of the ping before
  };
  void add_modulo(std::uint16_t number, std::int64_t time_ns);
  void add(std::uint64_t number, std::int64_t time_ns);

  std::uint64_t count() const { return numbers_.size(); }
  std::vector<Gap> gaps() const;
  const Stream& times() const { return times_; }

 private:
  static constexpr std::uint64_t kModulo = 65'536;

  std::map<std::uint64_t, std::int64_t> numbers_;  // with the time of each
  std::uint64_t last_ = 0;
  bool modulo_ = false;
  Stream times_;
};

/// A transducer or sensor, where it is installed and how it is turned.
struct Mounting {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;  // "x_m": "0.300", as the file has it
};

struct Kind {
  std::string about;  // in words; empty: not known here
  std::uint64_t count = 0;
};

struct Summary {
  std::string format;
  std::string system;  // model and serials
  std::uint64_t bytes = 0;
  std::map<std::string, Kind> kinds;  // datagrams by type
  Stream datagrams;
  Extent extent;
  Range depth_m;  // of valid soundings below the water line; of a sidescan, of the seabed below its sensor
  std::string depth_of;
  Stream positions;
  Stream attitudes;
  std::map<std::string, Pings> pings;          // with soundings, by head
  std::map<std::string, Pings> water_columns;  // pings with one, by head
  std::vector<Mounting> mountings;
  std::vector<std::string> notes;  // what other programs fail at
  formats::Faults faults;
};

}  // namespace ensonify::info
