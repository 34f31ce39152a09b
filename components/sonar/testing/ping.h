#pragma once

#include <optional>
#include <tuple>

#include "components/sonar/ping_cycle.h"
#include "components/sonar/surroundings.h"
#include "messages/sonar.h"

/// For tests of heads as values, without a node.
namespace ensonify {

/// Surroundings of a head that has no estimate of its own.
inline Surroundings around(const frames::PoseHistory& truth, const trace::Scene& seabed,
                           double known_sound_speed_mps = 1500.0) {
  static const frames::PoseHistory kNoEstimate(1);
  static const std::optional<uncertainty::Navigation> kNoErrors;
  return {truth, seabed, kNoEstimate, kNoErrors, known_sound_speed_mps};
}

/// A head's report of a ping that was sent with these settings.
template <class Head>
typename Head::Report report_of(Head& head, const PingEvent& event, const HeadSettings& settings,
                                const Surroundings& around) {
  return head.ping(event, head.transmit(event.transmit, settings, around), around);
}

/// Its image.
template <class Head>
msg::Ping image_of(Head& head, const PingEvent& event, const HeadSettings& settings, const Surroundings& around) {
  return std::get<0>(report_of(head, event, settings, around).messages).value();
}

}  // namespace ensonify
