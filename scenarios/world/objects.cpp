#include "scenarios/world/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "components/config/config_reader.h"
#include "kernels/base/random/stream.h"
#include "kernels/mesh/solids/words.h"
#include "scenarios/world/object_keys.h"

namespace ensonify {
namespace {

using frames::Vec2;

constexpr int kMostDraws = 1000;  // of a position, until it is far enough from the others
enum Draw : std::uint64_t { kAlong, kAcross, kScale, kHeading, kBurial };

/// Positions that are found by where they are.
class Apart {
 public:
  explicit Apart(double apart_m) : apart_m_(apart_m) {}

  /// Takes a position unless one is nearer than the distance.
  bool take(const Vec2& place_m) {
    if (apart_m_ == 0.0) return true;
    const auto [east, north] = cell(place_m);
    for (long e = east - 1; e <= east + 1; ++e) {
      for (long n = north - 1; n <= north + 1; ++n) {
        const auto [first, last] = taken_.equal_range({e, n});
        for (auto at = first; at != last; ++at) {
          if ((at->second - place_m).norm() < apart_m_) return false;
        }
      }
    }
    taken_.emplace(std::pair(east, north), place_m);
    return true;
  }

 private:
  std::pair<long, long> cell(const Vec2& place_m) const {
    return {std::lround(std::floor(place_m.x() / apart_m_)), std::lround(std::floor(place_m.y() / apart_m_))};
  }

  double apart_m_;
  std::multimap<std::pair<long, long>, Vec2> taken_;  // by cell
};

double between(const std::array<double, 2>& limits, double share) {
  return limits[0] + share * (limits[1] - limits[0]);
}

solids::Solid scaled(const solids::Solid& solid, double factor) {
  auto sizes = solids::sizes_of(solid);
  for (double& size : sizes) size *= factor;
  if (auto found = solids::solid_of(solids::word_of(solid), sizes)) return *std::move(found);
  solids::Mesh mesh = std::get<solids::Mesh>(solid);
  mesh.scale = sizes[0];
  return mesh;
}

std::vector<SceneObject> strewn(const StrewnObjectKeys& keys, const SceneObject& like, const ConfigReader& from,
                                std::uint64_t seed) {
  const random::Stream stream(seed, "objects/" + like.name);
  const Vec2 along = keys.to_enu_m - keys.from_enu_m;
  const Vec2 across = along.norm() > 0.0 ? Vec2(Vec2(along.y(), -along.x()).normalized()) : Vec2(1.0, 0.0);
  Apart apart(keys.apart_m);
  std::vector<SceneObject> objects;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(keys.count); ++i) {
    const auto drawn = [&](Draw what, std::uint64_t again = 0) { return stream.uniform(i, what, again); };
    Vec2 place;
    std::uint64_t draw = 0;
    do {
      place = keys.from_enu_m + drawn(kAlong, draw) * along + (drawn(kAcross, draw) - 0.5) * keys.width_m * across;
    } while (!apart.take(place) && ++draw < kMostDraws);
    if (draw == kMostDraws) {
      from.problem(
          "objects." + like.name + ".strewn.apart_m",
          fmt::format("keeps {} of {} objects apart there; allowed: fewer, nearer, or more room", i, keys.count));
      return objects;
    }
    SceneObject& object = objects.emplace_back(like);
    object.name = fmt::format("{}_{}", like.name, i + 1);
    object.place.position_enu_m.head<2>() = place;
    const std::array<double, 2> log_scale{std::log(keys.scale[0]), std::log(keys.scale[1])};
    object.solid = scaled(like.solid, std::exp(between(log_scale, drawn(kScale))));
    object.place.heading_rad = between(keys.heading_rad, drawn(kHeading));
    if (keys.burial) object.place.buried_share = between(*keys.burial, drawn(kBurial));
  }
  return objects;
}

/// The sections of a laid line, as long as each other.
std::vector<SceneObject> laid(const LaidKeys& keys, const SceneObject& like) {
  const auto route = std::make_shared<const LaidRoute>(LaidRoute{keys.through_enu_m, keys.taut_m, keys.burial});
  double length_m = 0.0;
  for (std::size_t i = 1; i < keys.through_enu_m.size(); ++i)
    length_m += (keys.through_enu_m[i] - keys.through_enu_m[i - 1]).norm();
  const int count = std::max(1, static_cast<int>(std::ceil(length_m / keys.section_m - 1e-9)));
  std::vector<SceneObject> sections;
  for (int i = 0; i < count; ++i) {
    SceneObject& section = sections.emplace_back(like);
    if (count > 1) section.name = fmt::format("{}_{}", like.name, i + 1);
    section.laid = LaidSection{route, length_m * i / count, length_m * (i + 1) / count};
    section.place.position_enu_m.head<2>() = position_on(*route, 0.5 * (section.laid->from_m + section.laid->to_m));
  }
  return sections;
}

bool is_line(const solids::Solid& solid) {
  return std::holds_alternative<solids::Cable>(solid) || std::holds_alternative<solids::Chain>(solid);
}

}  // namespace

frames::Vec2 position_on(const LaidRoute& route, double along_m) {
  const auto& places = route.through_enu_m;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double leg_m = (places[i] - places[i - 1]).norm();
    if (along_m <= leg_m || i + 1 == places.size())
      return places[i - 1] + std::clamp(along_m / leg_m, 0.0, 1.0) * (places[i] - places[i - 1]);
    along_m -= leg_m;
  }
  return places.front();
}

Eigen::Matrix3d ObjectPlace::enu_from_object() const {
  const frames::Vec3 hinge(-std::cos(tilt_heading_rad), std::sin(tilt_heading_rad), 0.0);
  return Eigen::AngleAxisd(tilt_rad, hinge).toRotationMatrix() *
         Eigen::AngleAxisd(-heading_rad, frames::Vec3::UnitZ()).toRotationMatrix();
}

void TyreKeys::check(const ConfigReader& from) const {
  if (!(diameter_m > 2.0 * width_m))
    from.problem("diameter_m", fmt::format("{:g} is not above twice its width_m of {:g}", diameter_m, width_m));
}

void PipeKeys::check(const ConfigReader& from) const {
  if (!(diameter_m > 2.0 * wall_m))
    from.problem("wall_m", fmt::format("{:g} leaves no bore in diameter_m {:g}; allowed: less than half of it", wall_m,
                                       diameter_m));
}

void ShellKeys::check(const ConfigReader& from) const {
  if (!(length_m > 1.25 * diameter_m))
    from.problem("length_m", fmt::format("{:g} is not above 1.25 of its diameter_m of {:g}", length_m, diameter_m));
}

void StrewnObjectKeys::check(const ConfigReader& from) const {
  const auto rises = [&](const char* key, const std::array<double, 2>& limits) {
    if (limits[0] > limits[1]) from.problem(key, "falls; allowed is [least, most]");
  };
  rises("scale", scale);
  rises("heading_deg", heading_rad);
  if (burial) rises("burial", *burial);
}

void LaidKeys::check(const ConfigReader& from) const {
  constexpr double kNearest_m = 0.01, kMostSections = 10'000.0;
  if (through_enu_m.size() < 2) return from.problem("through_m", "has fewer than two places; allowed: two or more");
  double length_m = 0.0;
  for (std::size_t i = 1; i < through_enu_m.size(); ++i) {
    const double leg_m = (through_enu_m[i] - through_enu_m[i - 1]).norm();
    if (leg_m < kNearest_m)
      return from.problem("through_m", fmt::format("has places {} and {} within {:g} m; allowed are places apart", i,
                                                   i + 1, kNearest_m));
    length_m += leg_m;
  }
  if (length_m > kMostSections * section_m)
    from.problem("section_m", fmt::format("makes {:.0f} sections of {:.0f} m; allowed are {:.0f}, so longer ones",
                                          length_m / section_m, length_m, kMostSections));
}

void StrewnObjectKeys::complete(ConfigReader& from) { place = from.node().place; }

void ObjectKeys::complete(ConfigReader& from) { written = from.node().place; }

/// All but where it stands.
SceneObject ObjectKeys::common() const {
  SceneObject object;
  object.name = name;
  object.solid = std::visit([](const auto& of) { return of.solid(); }, form);
  if (const auto* mesh = std::get_if<ObjectMesh>(&form))
    object.file = ObjectFile{mesh->keys.path, mesh->keys.unit_m, mesh->keys.y_is_up};
  object.class_name = class_name.empty() ? solids::word_of(object.solid) : class_name;
  object.place.heading_rad = heading_rad;
  object.place.tilt_rad = tilt_rad.value_or(0.0);
  object.place.tilt_heading_rad = tilt_heading_rad;
  object.smooth = material == Material::kSmooth;
  object.sediment = sediment;
  object.absent = absent;
  object.written = written;
  return object;
}

std::vector<SceneObject> ObjectKeys::objects(const ConfigReader& from, std::uint64_t seed) const {
  SceneObject object = common();
  const bool line = is_line(object.solid), lies = std::holds_alternative<ObjectLaid>(where);
  const double length_m = solids::sizes_of(object.solid)[1], sag_m = solids::sizes_of(object.solid)[2];
  const std::string key = "objects." + name;
  if (lies && !line)
    from.problem(key + ".laid",
                 fmt::format("is for a cable or a chain, and it is a {}", solids::word_of(object.solid)));
  if (lies && line && (length_m > 0.0 || sag_m > 0.0))
    from.problem(key + ".laid", "has its length and heights by its way; allowed: no length_m, no sag_m");
  if (!lies && line && !(length_m > 0.0))
    from.problem(key, "needs length_m, the distance between its ends, unless it is laid");
  if (std::holds_alternative<solids::Chain>(object.solid)) {
    constexpr double kMostLinks = 1500.0, kPitch = 4.0;  // in diameters of the wire
    const double wire_m = solids::sizes_of(object.solid)[0];
    const double links = (lies ? std::get<ObjectLaid>(where).keys.section_m : length_m) / (kPitch * wire_m);
    if (links > kMostLinks)
      from.problem(key + ".chain.wire_m", fmt::format("{:g} makes {:.0f} links; allowed are {:.0f} in a chain, or in a "
                                                      "section of a laid one",
                                                      wire_m, links, kMostLinks));
  }
  if (lies) return laid(std::get<ObjectLaid>(where).keys, object);
  if (const auto* many = std::get_if<ObjectStrewn>(&where)) {
    object.place.rests = !many->keys.burial && !tilt_rad;
    if (!object.place.rests) object.place.buried_share = 0.0;
    return strewn(many->keys, object, from, seed);
  }
  if (const auto* on = std::get_if<ObjectOnSeabed>(&where)) {
    object.place.position_enu_m.head<2>() = on->keys.at_enu_m;
    object.place.rests = !on->keys.burial && !tilt_rad;
    if (!object.place.rests) object.place.buried_share = on->keys.burial.value_or(0.0);
  } else {
    object.place.position_enu_m = std::get<ObjectInWater>(where).position_enu_m;
  }
  return {object};
}

std::vector<SceneObject> objects_of(const ConfigReader& from, const std::vector<ObjectKeys>& keys, const Seabed& seabed,
                                    std::uint64_t seed) {
  std::vector<SceneObject> objects;
  std::vector<std::string> classes;
  for (const ObjectKeys& one : keys) {
    if (one.material == ObjectKeys::Material::kDiffuse && !seabed.sediments.contains(one.sediment))
      from.problem("objects." + one.name + ".sediment", "is not a class of seabed.sediments");
    for (SceneObject& object : one.objects(from, seed)) {
      object.instance = static_cast<std::uint32_t>(objects.size()) + 1;
      auto at = std::ranges::find(classes, object.class_name);
      if (at == classes.end()) at = classes.insert(classes.end(), object.class_name);
      object.class_id = static_cast<std::uint32_t>(at - classes.begin()) + 1;
      objects.push_back(std::move(object));
    }
  }
  return objects;
}

}  // namespace ensonify
