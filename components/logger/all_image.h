#pragma once

#include <optional>

#include "components/formats/all/image.h"
#include "messages/soundings.h"

namespace ensonify::logger {

/// Most bytes of samples in a Y, so that it also goes over the network, whose datagrams end at 64 kB.
inline constexpr std::size_t kMostImageBytes = 60'000;

/// Y of a ping: of the head's image of the same ping; without one, one sample a beam, the sounding's strength. Series
/// that are too long together are cut to the same length around their detections.
formats::all::SeabedImage seabed_image(const msg::Soundings& soundings, const std::optional<msg::SeabedImage>& image);

}  // namespace ensonify::logger
