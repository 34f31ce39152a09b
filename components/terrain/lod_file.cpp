#include "components/terrain/lod_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/lattice_png.h"
#include "components/terrain/tiles/sha256.h"

namespace ensonify::source {
namespace {

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
