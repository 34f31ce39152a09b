#include "components/sonar/ping_pictures.h"

#include <utility>

#include "components/view/ping_view.h"

namespace ensonify {

namespace {
constexpr std::size_t kFanBeams = 3;  // with fewer a ping is a line
}

PingPictures::PingPictures(Ports& ports, const std::string& port, std::size_t max_bytes, std::string beam_axis)
    : ports_(ports), out_(ports.live_out<msg::View>(port, max_bytes)), beam_axis_(std::move(beam_axis)) {}

bool PingPictures::wanted() {
  if (!out_.watched()) return false;
  constexpr std::chrono::duration<double> kShortest(1.0 / kMostPerSecond);
  if (!are_lines_ && shown_ && Clock::now() - *shown_ < kShortest) return false;
  if (ports_.late()) ++left_out_;
  return !ports_.late();
}

void PingPictures::show(const msg::Ping& ping, const msg::Soundings* soundings) {
  are_lines_ = ping.beam_angle_rad.size() < kFanBeams;
  shown_ = Clock::now();
  try {
    msg::View view = view_of(ping, beam_axis_, {});
    view.left_out = left_out_;
    if (soundings != nullptr) add_finds(view, *soundings);
    out_.send(view);
  } catch (const NoPicture&) {
    // Nothing to show; the ping itself says what it lacks.
  }
}

}  // namespace ensonify
