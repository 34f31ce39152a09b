#pragma once

#include "components/formats/kmall/soundings.h"
#include "components/logger/format.h"
#include "components/logger/kmall/ping_info.h"

namespace ensonify::logger::kmall {

/// An entry of a ping's soundings. One without a detection keeps its sector and angles alone.
formats::kmall::Sounding sounding(const LoggedSoundings& ping, const PingPlace& place, std::size_t entry);

/// Adds the samples of the image, and to each sounding which of them are its own.
void add_image(const LoggedSoundings& ping, formats::kmall::Soundings& written);

}  // namespace ensonify::logger::kmall
