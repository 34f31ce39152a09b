#include "tools/grid/gridding.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "components/errors/exit_error.h"
#include "components/runtime/version.h"
#include "tools/grid/crs.h"

namespace ensonify::grid_tool {
namespace {

constexpr std::size_t kToChooseBy = 20'000;  // soundings whose depths choose the cell

/// Memory that cells may take: half of the machine's.
std::uint64_t most_bytes() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) /
         2;
}

std::string in_words(const std::string& datum) { return datum.empty() ? "an unstated datum" : datum; }

/// The datum of all files; points have none of their own.
std::string datum_of(const std::vector<std::unique_ptr<SoundingFile>>& files) {
  const FileFacts& first = files.front()->facts();
  for (const auto& file : files) {
    const FileFacts& facts = file->facts();
    if (facts.datum != first.datum)
      throw UserError(fmt::format("{}: its depths count from {}, those of {} from {}; allowed: one datum in a grid",
                                  facts.file, in_words(facts.datum), first.file, in_words(first.datum)));
    if (facts.origin.has_value() != first.origin.has_value())
      throw UserError(fmt::format("{}: {} where it is, {} {}; allowed: all files or none", facts.file,
                                  facts.origin ? "states" : "does not state", first.file,
                                  facts.origin ? "does not" : "does"));
  }
  return first.datum;
}

std::string map_of(const FileFacts& first, const std::string& crs) {
  if (first.origin) return crs.empty() ? map_about(*first.origin) : map_named(crs, *first.origin);
  if (!crs.empty()) throw UserError("--crs " + crs + ": " + first.file + " does not state where it is");
  return "";
}

/// Takes soundings; those that come before the cell is chosen wait.
class Filling {
 public:
  explicit Filling(std::optional<double> cell_m) {
    if (cell_m) grid_.emplace(*cell_m);
  }
  void take(const Sounding& sounding) {
    if (grid_) return add(sounding);
    waiting_.push_back(sounding);
    if (waiting_.size() == kToChooseBy) choose();
  }
  survey_grid::SoundingGrid finish() {
    if (!grid_) choose();
    return std::move(*grid_);
  }

 private:
  void add(const Sounding& sounding) {
    grid_->add(sounding.x_m, sounding.y_m, sounding.depth_m, sounding.sd_m);
    if (grid_->bytes() > most_bytes_)
      throw UserError(
          fmt::format("--cell {:g}: the soundings are so far apart that their cells take half of the "
                      "machine's memory; use larger ones",
                      grid_->cell_m()));
  }
  void choose() {
    std::vector<double> depths_m;
    for (const Sounding& sounding : waiting_) {
      if (std::isfinite(sounding.depth_m)) depths_m.push_back(sounding.depth_m);
    }
    double median_m = 0.0;
    if (!depths_m.empty()) {
      const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
      std::nth_element(depths_m.begin(), middle, depths_m.end());
      median_m = *middle;
    }
    grid_.emplace(cell_for_depth_m(median_m));
    for (const Sounding& sounding : waiting_) add(sounding);
    waiting_.clear();
  }

  std::uint64_t most_bytes_ = most_bytes();
  std::vector<Sounding> waiting_;
  std::optional<survey_grid::SoundingGrid> grid_;
};

}  // namespace

double cell_for_depth_m(double depth_m) {
  double cell_m = 0.1;
  for (const double next_m : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    if (next_m <= 0.05 * depth_m) cell_m = next_m;
  }
  return cell_m;
}

Gridded grid_of(const std::vector<std::unique_ptr<SoundingFile>>& files, const GridOptions& options) {
  const std::string datum = datum_of(files);
  const std::string map = map_of(files.front()->facts(), options.crs);
  Filling filling(options.cell_m);
  std::uint64_t left_out = 0;
  std::vector<std::string> sources;
  for (const auto& file : files) {
    const FileFacts& facts = file->facts();
    sources.push_back(facts.file);
    const Transformation to_map(facts.origin ? map_about(*facts.origin) : map, map);
    file->read([&](Sounding sounding) {
      const bool known = std::isfinite(sounding.x_m) && std::isfinite(sounding.y_m) && std::isfinite(sounding.depth_m);
      if (known && to_map.transform(sounding.x_m, sounding.y_m)) filling.take(sounding);
      else ++left_out;
    });
  }
  return {filling.finish(), {map, datum, sources, kVersion}, left_out};
}

}  // namespace ensonify::grid_tool
