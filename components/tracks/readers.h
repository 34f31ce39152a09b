#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/tracks/track.h"

/// The readers of single formats, and what they share.
namespace ensonify::tracks {

Track read_csv(const std::string& file);
Track read_nmea_log(const std::string& file);
Track read_record(const std::string& file, const std::string& topic);
Track read_all(const std::string& file);
Track read_kmall(const std::string& file);
Track read_xtf(const std::string& file);

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Appends what is later than all before. Of two at one time the first counts: files say things twice. `where` is the
/// place in the file, with what is appended.
template <class One>
void append(std::vector<One>& to, const One& one, const std::string& where) {
  if (!to.empty() && one.ns == to.back().ns) return;
  if (!to.empty() && one.ns < to.back().ns) {
    throw UserError(fmt::format("{}: time runs back by {:.3f} s; allowed: times that rise. Cut the file there", where,
                                1e-9 * static_cast<double>(to.back().ns - one.ns)));
  }
  to.push_back(one);
}

}  // namespace ensonify::tracks
