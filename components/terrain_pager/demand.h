#pragma once

#include <map>
#include <string>

namespace ensonify::pager {

/// Distance from the vehicle to which heads need the seabed, m. Each head notes how far it can be set to receive,
/// `bow/reach_m`, its place on the vehicle included; what an operator's command can ask for is within that, so tiles
/// are there before a command takes effect. A head that follows the depth by itself (`bow/auto_range`) has no use for
/// more than what lies within 71 degrees of nadir: three times the greatest depth + 20 m. Without any head it is this,
/// too. Never less than the greatest depth + 20 m: Doppler logs and altimeters point down at no more than 45 degrees.
double demanded_m(const std::map<std::string, std::string>& facts, double deepest_m);

}  // namespace ensonify::pager
