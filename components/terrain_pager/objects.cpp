#include "components/terrain_pager/objects.h"

#include <fmt/format.h>

#include <utility>

#include "components/terrain/placed_object.h"
#include "components/terrain_pager/mission_track.h"

namespace ensonify::pager {
Objects::Objects(const TerrainPagerConfig& config, const source::TerrainSource& terrain) {
  if (config.objects.empty()) return;
  const MissionTrack track = track_of(config);
  for (const SceneObject& object : config.objects) {
    source::PlacedObject placed = source::placed_object(object, terrain);
    const Eigen::AlignedBox3d& box = placed.box_enu_m;
    if (box.max().z() > track.lowest_water_m)
      source::refuse(object, fmt::format("reaches {:.2f} m above chart datum, and the water falls to {:.2f} m; allowed "
                                         "is what stays below the water",
                                         box.max().z(), track.lowest_water_m));
    check_legs(track, "the object " + object.name, placed.surface.mesh);
    objects_.push_back({std::move(placed.message), {box.min().head<2>(), box.max().head<2>()}});
  }
}

Objects::Decision Objects::update(const frames::Vec2& place_enu_m, const paging::Margins& margins) {
  Decision decision;
  for (One& one : objects_) {
    const double away_m = paging::distance_m(one.box, place_enu_m);
    if (!one.at_heads && away_m <= margins.feed_m) {
      one.at_heads = true;
      decision.publish.push_back(&one.message);
    } else if (one.at_heads && away_m > margins.release_m) {
      one.at_heads = false;
      decision.release.push_back(one.message.number);
    }
  }
  return decision;
}

}  // namespace ensonify::pager
