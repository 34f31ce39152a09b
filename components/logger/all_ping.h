#pragma once

#include "components/formats/all/soundings.h"
#include "components/logger/vessel.h"
#include "kernels/base/frames/local_projection.h"
#include "messages/soundings.h"

/// N and X of a ping in a .all file, with all beams in each, valid or not. Y is in all_image.h.
namespace ensonify::logger {

formats::all::RawRangeAngle raw_range_angle(const msg::Soundings& soundings);

/// `heave_down_m`: measured, at transmission.
formats::all::Soundings xyz(const msg::Soundings& soundings, const Vessel& vessel, const frames::LocalProjection& world,
                            double heave_down_m);

}  // namespace ensonify::logger
