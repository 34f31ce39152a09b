#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "components/formats/xtf/ping.h"
#include "components/logger/xtf/samples.h"
#include "messages/sonar.h"

namespace ensonify::logger {

std::uint16_t bytes_of(XtfSamples samples);
/// The number that stands for them in a channel's head.
std::uint8_t format_of(XtfSamples samples);

/// Both sides of a transmission as channels `first` and `first` + 1, port far range first. Samples have the gain that
/// the head applied in them: counts of its converter, where it has one, else amplitudes over full_scale_upa(). More
/// samples than readers bear (formats::xtf::kMostSampleBytes) are joined, as root mean squares of equal numbers.
/// Nothing for a ping that is not of two sides.
std::vector<formats::xtf::Channel> xtf_channels(const msg::Ping& ping, std::uint16_t first, XtfSamples samples);

/// How many samples of a ping become one.
std::size_t joined_samples(std::size_t count, XtfSamples samples);

/// The amplitude, gain included, that integers end at: 10 dB above what the strongest seabed (0 dB) gives anywhere in
/// the range, by the ping's own settings: SL - 30 log10(R) + 10 log10(theta c tau / 2) + gain(R), with the absorption
/// that the operator takes out. Equal for all pings of the same settings.
double full_scale_upa(const msg::AppliedSettings& settings);

}  // namespace ensonify::logger
