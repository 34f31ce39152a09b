#include "components/logger/instruments.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/errors/exit_error.h"

namespace ensonify::logger {

namespace {

constexpr double kLowest_hz = 200e3, kHighest_hz = 400e3;  // of an EM 2040

bool is_kongsberg(const std::string& format) { return format != "xtf"; }

}  // namespace

void check_instrument(const std::string& process, const LoggedFormats& formats, const std::string& head,
                      const msg::HeadDeclaration& declared) {
  const auto unwanted = std::find_if(formats.begin(), formats.end(), is_kongsberg);
  if (unwanted == formats.end() || declared.kind.empty()) return;
  const bool generic = declared.instrument.empty() || declared.instrument == "generic";
  if (!generic && declared.instrument != "em2040") {
    throw UserError(
        fmt::format("{}: formats: {}: {} stands for the class {}, whose instruments do not write it; allowed: xtf, or "
                    "a head of the "
                    "class em2040 or generic",
                    process, *unwanted, head, declared.instrument));
  }
  for (const msg::ChannelDeclaration& channel : declared.channels) {
    for (const msg::SectorDeclaration& sector : channel.sectors) {
      if (!generic || (sector.frequency_hz >= kLowest_hz && sector.frequency_hz <= kHighest_hz)) continue;
      throw UserError(
          fmt::format("{}: formats: {}: is written of heads from {:g} to {:g} kHz, and {} sends at {:g} kHz; "
                      "allowed: xtf",
                      process, *unwanted, 1e-3 * kLowest_hz, 1e-3 * kHighest_hz, head, 1e-3 * sector.frequency_hz));
    }
  }
}

void check_soundings(const std::string& process, const LoggedFormats& formats, const std::string& head,
                     std::size_t soundings) {
  constexpr std::size_t kMostSoundings = 1'024;
  const auto unwanted = std::find_if(formats.begin(), formats.end(), is_kongsberg);
  if (unwanted == formats.end() || soundings <= kMostSoundings) return;
  throw UserError(
      fmt::format("{}: formats: {}: {} gives {} soundings a ping, and readers of the format have room for {}; "
                  "allowed: fewer beams, soundings or detections_per_beam, or xtf",
                  process, *unwanted, head, soundings, kMostSoundings));
}

std::string simulated_by(const std::string& instrument) {
  const bool generic = instrument.empty() || instrument == "generic";
  return generic ? "simulated by Ensonify: a generic head" : "simulated by Ensonify";
}

}  // namespace ensonify::logger
