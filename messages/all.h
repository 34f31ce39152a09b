#pragma once

#include <tuple>

#include "messages/actuators.h"
#include "messages/clock.h"
#include "messages/console.h"
#include "messages/declarations.h"
#include "messages/feed.h"
#include "messages/health.h"
#include "messages/labels.h"
#include "messages/mission.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/sonar.h"
#include "messages/soundings.h"
#include "messages/terrain.h"
#include "messages/view.h"

namespace ensonify::msg {

/// Every message type, the only list of them. A new type is added here; a test finds one that was forgotten.
using AllMessages =
    std::tuple<Pose, Guidance, Actuators, Helm, MissionState, Mark, NextLine, Coverage, Attitude, Position, SoundSpeed,
               Estimate, DelayedHeave, Heading, InertialIncrements, VelocityLog, Depth, Altitude, CurrentProfile, Ctd,
               UsblFix, Ping, Soundings, Snippets, SeabedImage, BottomTrack, Labels, Energies, Transmit, SonarSettings,
               Tile, TileRelease, Mesh, MeshRelease, Object, ObjectMesh, ObjectRelease, Chart, FeedData,
               HeadDeclaration, PagerDeclaration, Health, ClockHealth, View, ConsoleState, ConsoleFlow, ConsoleCells,
               ConsoleTrack, ConsoleValues, ConsoleAlarms, ConsoleLog, ConsoleRelief, ConsolePlan, ConsoleEnter,
               ConsoleWatch, ConsoleDrawn, ConsoleOpen, ConsoleCommand, ConsoleAnswer>;

/// Calls `visit(M{})` for every message type.
template <class Visit>
void for_each_message(Visit&& visit) {
  std::apply([&](const auto&... message) { (visit(message), ...); }, AllMessages{});
}

}  // namespace ensonify::msg
