#pragma once

#include <optional>
#include <span>
#include <string>

#include "components/formats/kmall/navigation.h"
#include "components/formats/kmall/sound_speed.h"
#include "components/logger/moment.h"

/// Navigation of a .kmall file.
namespace ensonify::logger::kmall {

/// Of the reference point, at a moment at which a position is due.
formats::kmall::Position position(const Moment& moment);

/// The position that .all files have, at the water line.
formats::kmall::CompatiblePosition compatible_position(const Moment& moment);

/// Most samples of a #SKM.
inline constexpr std::size_t kMostMotionSamples = 148;

/// Of moments in their order, at most kMostMotionSamples: else std::invalid_argument. Rates are the differences of
/// neighbours; `before` is the moment before the first, where there was one.
formats::kmall::Motion motion(std::span<const Moment> moments, const std::optional<Moment>& before);

/// "INZDA,120000.00,01,06,2025,00,00*7B": without $ and line end.
std::string zda_text(std::int64_t unix_ns);
/// Of a clock that is right.
formats::kmall::Clock clock(std::int64_t unix_ns);

formats::kmall::SurfaceSoundSpeed surface_sound_speed(std::int64_t unix_ns, double sound_speed_mps);

}  // namespace ensonify::logger::kmall
