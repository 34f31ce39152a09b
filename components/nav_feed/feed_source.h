#pragma once

#include "components/config/parameters.h"
#include "components/feeds/byte_source.h"
#include "kernels/base/frames/pose.h"

namespace ensonify {

class ConfigReader;

/// One source of the feed: how its bytes come, what they are and what they are taken for.
struct FeedSource : ByteSource {
  enum class Format { kNmea, kTss1, kEmAttitude, kKmBinary };
  enum class TimeScale {
    kUtc,
    kGps,   // ahead of UTC by the leap seconds since 1980
    kNone,  // its times are not used: arrivals count
  };
  enum class HeightOf {
    kGeoid,      // GGA's altitude as it stands
    kEllipsoid,  // GGA's altitude and separation together, less the scenario's geoid
  };

  Format format = Format::kNmea;
  bool place = true, heading = true, motion = true;
  bool roll_reversed = false, pitch_reversed = false, heave_reversed = false;
  TimeScale time_scale = TimeScale::kUtc;
  double latency_s = 0.0;
  HeightOf height_of = HeightOf::kGeoid;
  frames::Vec3 antenna_body_m = frames::Vec3::Zero();
  frames::Vec3 heave_body_m = frames::Vec3::Zero();

  static void parameters(auto& self, auto&& visit) {
    ByteSource::parameters(self, visit);
    visit("format", "",
          one_of({{"nmea", Format::kNmea},
                  {"tss1", Format::kTss1},
                  {"em_attitude", Format::kEmAttitude},
                  {"km_binary", Format::kKmBinary}}),
          "format of the bytes; em_attitude: of EM 3000 and EM 1000", self.format);
    visit("place", "", any(), "taking of its fixes; one source alone may give them", self.place);
    visit("heading", "", any(), "taking of its headings", self.heading);
    visit("motion", "", any(), "taking of its roll, pitch and heave", self.motion);
    visit("roll_reversed", "", any(), "opposite sign of its roll: positive with starboard up", self.roll_reversed);
    visit("pitch_reversed", "", any(), "opposite sign of its pitch: positive with the bow down", self.pitch_reversed);
    visit("heave_reversed", "", any(), "opposite sign of its heave to what its format says", self.heave_reversed);
    visit("time_scale", "", one_of({{"utc", TimeScale::kUtc}, {"gps", TimeScale::kGps}, {"none", TimeScale::kNone}}),
          "scale of its times; none: they are not used, and arrivals count", self.time_scale);
    visit("latency_s", "s", in(0, 10), "time from the measurement to the arrival", self.latency_s);
    visit("height_of", "", one_of({{"geoid", HeightOf::kGeoid}, {"ellipsoid", HeightOf::kEllipsoid}}),
          "surface of GGA's heights; ellipsoid: its separation is added, and the scenario's geoid counts",
          self.height_of);
    visit("antenna_position_m", "m", in(-500, 500),
          "the place on the body that its fixes are of: forward, starboard, down (up is negative)",
          self.antenna_body_m);
    visit("heave_position_m", "m", in(-500, 500),
          "the place on the body that its heave is of: forward, starboard, down", self.heave_body_m);
  }
  void check(const ConfigReader& from) const;

  bool may_give_places() const { return place && (format == Format::kNmea || format == Format::kKmBinary); }
  bool heights_are_of_ellipsoid() const { return height_of == HeightOf::kEllipsoid || format == Format::kKmBinary; }
};

}  // namespace ensonify
