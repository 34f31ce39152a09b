#include "kernels/survey/boresight/cells.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ensonify::boresight {

namespace {

struct Filed {
  std::int64_t row, column;
  SoundingRef ref;
  auto key() const { return std::tuple(row, column, ref.line, ref.index); }
};

std::vector<Filed> filed(const std::vector<std::vector<frames::Vec3>>& places_enu_m, double side_m,
                         const frames::Vec2& corner_m) {
  const auto square = [&](double along_m) { return std::llround(std::floor(along_m / side_m)); };
  std::vector<Filed> all;
  for (std::uint32_t line = 0; line < places_enu_m.size(); ++line) {
    for (std::uint32_t i = 0; i < places_enu_m[line].size(); ++i) {
      const frames::Vec3& p = places_enu_m[line][i];
      all.push_back({square(p.y() - corner_m.y()), square(p.x() - corner_m.x()), {line, i}});
    }
  }
  std::sort(all.begin(), all.end(), [](const Filed& a, const Filed& b) { return a.key() < b.key(); });
  return all;
}

}  // namespace

Cells::Cells(const std::vector<std::vector<frames::Vec3>>& places_enu_m, double side_m, std::size_t least,
             const frames::Vec2& corner_m) {
  const std::vector<Filed> all = filed(places_enu_m, side_m, corner_m);
  starts_.push_back(0);
  for (auto from = all.begin(); from != all.end();) {
    const auto to =
        std::find_if(from, all.end(), [&](const Filed& f) { return f.row != from->row || f.column != from->column; });
    int lines = 0;
    for (auto first = from; first != to;) {
      const auto last = std::find_if(first, to, [&](const Filed& f) { return f.ref.line != first->ref.line; });
      if (static_cast<std::size_t>(last - first) >= least) {
        ++lines;
        for (; first != last; ++first) members_.push_back(first->ref);
      }
      first = last;
    }
    if (lines >= 2) {
      starts_.push_back(members_.size());
    } else {
      members_.resize(starts_.back());
    }
    from = to;
  }
}

}  // namespace ensonify::boresight
