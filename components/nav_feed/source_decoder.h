#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "components/feeds/lines.h"
#include "components/formats/em_attitude/em_attitude.h"
#include "components/formats/km_binary/km_binary.h"
#include "components/formats/nmea/navigation.h"
#include "components/formats/tss1/tss1.h"
#include "components/nav_feed/feed_source.h"

namespace ensonify {

/// What the bytes of one source say, whatever their format, with the signs and in the time scale of the feed: port up,
/// bow up, heave up and of the reference point, UTC.
class SourceDecoder {
 public:
  using Each = std::function<void(const nmea::Navigation&)>;
  using Count = std::function<void(const std::string&)>;
  SourceDecoder(const FeedSource& source, Count count);

  /// `begins`: of a new connection; `whole`: a datagram, whose last sentence needs no line end.
  void take(std::string_view bytes, bool begins, bool whole, const Each& each);

  static constexpr double kGpsAhead_s = 18.0;  // of UTC, since 2017

 private:
  void give(nmea::Navigation found, const Each& each);
  void give(const std::optional<formats::Motion>& motion, const Each& each);
  void correct(formats::Motion& motion);
  double utc_s(double time_s) const;
  /// Whether a time of day of the source's scale is UTC's of the day before.
  bool is_of_the_day_before(double time_s) const;

  FeedSource source_;
  Count count_;
  Lines lines_;  // of NMEA
  formats::tss1::Stream tss1_;
  formats::em_attitude::Stream em_attitude_;
  formats::km_binary::Stream km_binary_;
  double roll_rad_ = 0.0, pitch_rad_ = 0.0;  // the last ones that it gave, for the place of its heave
};

}  // namespace ensonify
