#pragma once

#include <array>
#include <cstddef>

/// What nav_out can say: sentences of NMEA 0183, and frames of formats that have one kind alone.
namespace ensonify::nav_out {

/// Where a sentence's values come from. One leaves for each measurement of it, or for some of them.
enum class Source { kPosition, kAttitude, kHeading, kEstimate, kAltitude, kVessels, kClock };

enum class Kind {
  kZda,  // first: it leaves first at its second
  kGga,
  kGst,
  kVtg,
  kHdt,
  kRot,
  kPashr,
  kPsxn20,
  kPsxn23,
  kDpt,
  kDbt,
  kVdo,
  kVdm,
  kTss1,
  kEmAttitude,
  kKmBinary,
};

struct KindInfo {
  Kind kind;
  const char* name;
  Source source;
  std::size_t most_bytes;  // of one
};

inline constexpr std::array kSentences{
    KindInfo{Kind::kZda, "ZDA", Source::kClock, 38},          KindInfo{Kind::kGga, "GGA", Source::kPosition, 100},
    KindInfo{Kind::kGst, "GST", Source::kPosition, 60},       KindInfo{Kind::kVtg, "VTG", Source::kEstimate, 50},
    KindInfo{Kind::kHdt, "HDT", Source::kHeading, 19},        KindInfo{Kind::kRot, "ROT", Source::kHeading, 22},
    KindInfo{Kind::kPashr, "PASHR", Source::kAttitude, 80},   KindInfo{Kind::kPsxn20, "PSXN20", Source::kAttitude, 21},
    KindInfo{Kind::kPsxn23, "PSXN23", Source::kAttitude, 42}, KindInfo{Kind::kDpt, "DPT", Source::kAltitude, 32},
    KindInfo{Kind::kDbt, "DBT", Source::kAltitude, 40},       KindInfo{Kind::kVdo, "VDO", Source::kEstimate, 49},
    KindInfo{Kind::kVdm, "VDM", Source::kVessels, 50},
};
inline constexpr KindInfo kTss1{Kind::kTss1, "TSS1", Source::kAttitude, 27};
inline constexpr KindInfo kEmAttitude{Kind::kEmAttitude, "EM attitude", Source::kAttitude, 10};
inline constexpr KindInfo kKmBinary{Kind::kKmBinary, "KM binary", Source::kEstimate, 132};

}  // namespace ensonify::nav_out
