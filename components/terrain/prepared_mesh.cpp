#include "components/terrain/prepared_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "components/config/config_error.h"
#include "components/terrain/mesh_file.h"
#include "components/terrain/tiles/file_bytes.h"
#include "kernels/mesh/progressive/hierarchy.h"

namespace ensonify::source {
namespace {

/// In metres, about a whole number of them in its middle.
progressive::TriangleMesh metres_of(const MeshFile& file, double unit_m) {
  Eigen::AlignedBox3d box;
  for (const frames::Vec3& place : file.vertex) box.extend(place * unit_m);
  progressive::TriangleMesh mesh;
  if (!box.isEmpty()) mesh.origin_enu_m = box.center().array().round() + 0.0;  // no -0
  for (const frames::Vec3& place : file.vertex)
    mesh.vertex_m.emplace_back((place * unit_m - mesh.origin_enu_m).cast<float>());
  mesh.triangle = file.triangle;
  return mesh;
}

/// What was made of this very file before; nothing if it was not, or is damaged.
std::optional<LodFile> made_before(const std::string& path, const std::string& made_from, double unit_m) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    LodFile lod = read_lod_file(path);
    if (lod.source_sha256 == made_from && lod.unit_m == unit_m) return lod;
  } catch (const tiles::TileError&) {  // made again
  }
  return std::nullopt;
}

progressive::Hierarchy hierarchy_of(progressive::TriangleMesh mesh) {
  const auto collapses = progressive::collapses_of(mesh);
  return progressive::hierarchy_of(std::move(mesh), collapses);
}

bool is_on(const std::vector<std::uint8_t>& classes, const Vec2& place, const TerrainSource& ground) {
  if (classes.empty()) return true;
  const double spacing_m = ground.native_spacing_m();
  const PostBlock nearest{std::llround(place.x() / spacing_m), std::llround(place.y() / spacing_m), 1, 1, spacing_m};
  float height_m = 0.0F;
  std::uint8_t sediment = 0;
  ground.sample(nearest, {&height_m, 1}, {&sediment, 1});
  return std::find(classes.begin(), classes.end(), sediment) != classes.end();
}

[[noreturn]] void refuse(const SeabedMesh& mesh, const std::string& why) {
  throw ConfigError({ConfigProblem{mesh.strewn->place, "seabed.meshes." + mesh.name + ".strewn", why}});
}

/// As many places of copies as the scenario asks for.
std::vector<progressive::Copy> places_of(const SeabedMesh& mesh, const random::Stream& stream,
                                         const TerrainSource& ground) {
  constexpr std::uint64_t kDrawsPerCopy = 1000;
  const StrewnCopies& strewn = *mesh.strewn;
  const auto count = static_cast<std::size_t>(strewn.count);
  std::vector<progressive::Copy> copies;
  for (std::uint64_t draw = 0; draw < kDrawsPerCopy * count && copies.size() < count; ++draw) {
    progressive::Copy copy = progressive::drawn(strewn.where, stream, draw);
    const Vec2 place = copy.position_enu_m.head<2>();
    copy.position_enu_m.z() = ground.height_m(place);
    if (std::isfinite(copy.position_enu_m.z()) && is_on(strewn.on, place, ground)) copies.push_back(copy);
  }
  if (copies.size() < count)
    refuse(mesh, fmt::format("found ground for {} of {} copies; widen the rectangle, or `on`", copies.size(), count));
  return copies;
}

progressive::Hierarchy strewn_over(const TerrainSource& ground, const SeabedMesh& mesh, const random::Stream& stream,
                                   const progressive::Hierarchy& one) {
  constexpr std::size_t kMost = 2'000'000;
  const std::size_t vertices = one.mesh.vertex_m.size() * static_cast<std::size_t>(mesh.strewn->count);
  if (vertices > kMost) refuse(mesh, fmt::format("makes {} vertices; allowed: {}", vertices, kMost));
  return progressive::copies_of(one, places_of(mesh, stream, ground));
}

/// From the axes of the file to x east, y north, z up.
Eigen::Matrix3d upright(const SeabedMesh& mesh) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (mesh.up == SeabedMesh::Up::kY) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

/// Turned by its heading, then tilted towards the heading of its tilt.
Eigen::Matrix3d turn_of(const SeabedMesh& mesh) {
  const frames::Vec3 hinge(-std::cos(mesh.tilt_heading_rad), std::sin(mesh.tilt_heading_rad), 0.0);
  return Eigen::AngleAxisd(mesh.tilt_rad, hinge).toRotationMatrix() *
         Eigen::AngleAxisd(-mesh.heading_rad, frames::Vec3::UnitZ()).toRotationMatrix() * upright(mesh);
}

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kFormat = "ensonify: lod/1\n";
constexpr std::size_t kDigest = 64;  // hexadecimal digits

using progressive::Split;

/// Calls visit for each number of a hierarchy, in the file's order; arrays have their lengths already.
template <class Hierarchy, class Visit>
void for_numbers(Hierarchy& h, Visit visit) {
  for (auto& v : h.mesh.vertex_m) visit(v.x()), visit(v.y()), visit(v.z());
  for (auto& t : h.mesh.triangle) visit(t[0]), visit(t[1]), visit(t[2]);
  for (auto& s : h.splits) {
    visit(s.removed), visit(s.kept), visit(s.parent), visit(s.child[0]), visit(s.child[1]);
    visit(s.first_born), visit(s.born), visit(s.deviation_m);
    for (int axis = 0; axis < 3; ++axis) visit(s.box_m.min()[axis]), visit(s.box_m.max()[axis]);
  }
  for (auto& t : h.born) visit(t);
  for (auto& t : h.coarsest) visit(t);
  for (auto& s : h.split_of) visit(s);
}

template <class Number>
void put(std::vector<std::uint8_t>& bytes, const Number& number) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(&number);
  bytes.insert(bytes.end(), raw, raw + sizeof number);
}

/// Takes numbers out of bytes, one after another. What lies behind the end is 0, and `short_of` says so.
struct Reader {
  std::span<const std::uint8_t> bytes;
  std::size_t at = 0;
  bool short_of = false;

  template <class Number>
  void get(Number& number) {
    number = {};
    short_of = short_of || bytes.size() - at < sizeof number;
    if (short_of) return;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    at += sizeof number;
  }
  /// A length of things of so many bytes each, which must be there.
  std::size_t length(std::size_t each) {
    std::uint64_t count = 0;
    get(count);
    short_of = short_of || count > bytes.size() / each;
    return short_of ? 0 : static_cast<std::size_t>(count);
  }
};

std::string digest_of(std::span<const std::uint8_t> bytes) {
  tiles::Sha256 sum;
  sum.add(std::as_bytes(bytes));
  return sum.digest();
}

}  // namespace

std::string lod_path_of(const std::string& mesh_path) { return mesh_path + ".lod"; }

PreparedMesh prepared_mesh(const std::string& mesh_path, double unit_m, const std::string& lod_path) {
  const std::string made_from = tiles::sha256_of_file(mesh_path);
  if (auto lod = made_before(lod_path, made_from, unit_m)) return {std::move(*lod), true};
  progressive::TriangleMesh mesh = metres_of(read_mesh_file(mesh_path), unit_m);
  if (const std::string fault = fault_of(mesh); !fault.empty())
    throw ConfigError({ConfigProblem{{mesh_path, 0, 0}, "", fault}});
  return {LodFile{hierarchy_of(std::move(mesh)), made_from, unit_m}, false};
}

PlacedMesh placed_mesh(const SeabedMesh& mesh, std::uint64_t seed, const TerrainSource& ground) {
  constexpr std::size_t kAtOnce = 2000;  // vertices whose splits are made in a tenth of a second
  const random::Stream stream{seed, "seabed/meshes/" + mesh.name};
  if (mesh.wall) return {hierarchy_of(progressive::mesh_of(*mesh.wall, stream))};
  PreparedMesh one;
  if (mesh.bars.empty()) one = prepared_mesh(mesh.file, mesh.unit_m, lod_path_of(mesh.file));
  else one = {{hierarchy_of(progressive::mesh_of(mesh.bars)), "", 1.0}, true};
  progressive::Hierarchy& hierarchy = one.lod.hierarchy;
  const bool worth_preparing = !one.cached && hierarchy.mesh.vertex_m.size() > kAtOnce;
  if (mesh.strewn) {
    if (mesh.up != SeabedMesh::Up::kZ)
      hierarchy = progressive::placed(std::move(hierarchy), frames::Vec3::Zero(), upright(mesh));
    return {strewn_over(ground, mesh, stream, hierarchy), worth_preparing};
  }
  return {progressive::placed(std::move(hierarchy), mesh.position_enu_m, turn_of(mesh)), worth_preparing};
}

void write_lod_file(const std::string& path, const LodFile& lod) {
  const auto& h = lod.hierarchy;
  std::vector<std::uint8_t> bytes(kFormat.begin(), kFormat.end());
  bytes.insert(bytes.end(), lod.source_sha256.begin(), lod.source_sha256.end());
  put(bytes, lod.unit_m);
  for (int axis = 0; axis < 3; ++axis) put(bytes, h.mesh.origin_enu_m[axis]);
  for (const std::size_t count :
       {h.mesh.vertex_m.size(), h.mesh.triangle.size(), h.splits.size(), h.born.size(), h.coarsest.size()})
    put(bytes, static_cast<std::uint64_t>(count));
  for_numbers(h, [&](const auto& number) { put(bytes, number); });
  const std::string digest = digest_of(bytes);
  bytes.insert(bytes.end(), digest.begin(), digest.end());
  tiles::write_file(path, bytes);
}

LodFile read_lod_file(const std::string& path) {
  const std::vector<std::uint8_t> file = tiles::read_file(path);
  if (file.size() < kFormat.size() + 2 * kDigest || !std::equal(kFormat.begin(), kFormat.end(), file.begin()))
    throw tiles::TileError(path + ": is no mesh with level of detail of this version (lod/1)");
  const auto body = std::span(file).first(file.size() - kDigest);
  if (digest_of(body) != std::string(file.end() - kDigest, file.end()))
    throw tiles::TileError(path + ": is damaged: its checksum does not fit");
  LodFile lod;
  auto& h = lod.hierarchy;
  const auto source = body.begin() + kFormat.size();
  lod.source_sha256.assign(source, source + kDigest);
  Reader from{body, kFormat.size() + kDigest};
  from.get(lod.unit_m);
  for (int axis = 0; axis < 3; ++axis) from.get(h.mesh.origin_enu_m[axis]);
  h.mesh.vertex_m.resize(from.length(12));
  h.mesh.triangle.resize(from.length(12));
  h.splits.resize(from.length(56));
  h.born.resize(from.length(4));
  h.coarsest.resize(from.length(4));
  h.split_of.resize(h.mesh.vertex_m.size());
  for_numbers(h, [&](auto& number) { from.get(number); });
  if (from.short_of || from.at != body.size())
    throw tiles::TileError(path + ": is damaged: it is too short or too long");
  return lod;
}

}  // namespace ensonify::source
