#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/terrain/import/mosaic.h"

namespace ensonify::terrain_import {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kListedSpikes = 20;

/// Six digits say enough of what was measured.
double six(double value) { return std::stod(fmt::format("{:.6g}", value)); }

std::string area(double m2) { return m2 < 1e5 ? fmt::format("{:.0f} m2", m2) : fmt::format("{:.4g} km2", m2 / 1e6); }

std::string crs_of(const SurveyFile& file) {
  const OGRSpatialReference& reference = file.raster->reference();
  const char* authority = reference.GetAuthorityName(nullptr);
  const char* code = reference.GetAuthorityCode(nullptr);
  const char* name = reference.GetName();
  const std::string called = name != nullptr ? name : "unnamed";
  return authority != nullptr && code != nullptr ? fmt::format("{} ({}:{})", called, authority, code) : called;
}

/// Cells lie where a file has them, posts only between four of them: a rim is lost around every hole.
double lost_m2(const Share& share) { return std::max(0.0, share.surveyed_m2 - share.known_m2); }

/// The shortest wave that a file's heights are assumed to show, m.
double band_start_m(const SurveyFile& file, const Share& share) {
  return std::max(file.removed_below_cells, file.band.begins_cells) * share.cell_m;
}

Json spikes_json(const SurveyFile& file) {
  auto spikes = file.spikes;
  std::stable_sort(spikes.begin(), spikes.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.above_m) > std::abs(b.above_m); });
  spikes.resize(std::min(spikes.size(), kListedSpikes));
  Json largest = Json::array();
  for (const auto& spike : spikes)
    largest.push_back({{"column", spike.column}, {"row", spike.row}, {"above_m", six(spike.above_m)}});
  return {{"count", file.spikes.size()}, {"removed", file.despiked}, {"largest", largest}};
}

Json stripes_json(const SurveyFile& file, const Share& share) {
  Json json = {{"found", file.stripes.found}, {"contrast", six(file.stripes.contrast)}};
  if (!file.stripes.found) return json;
  json["azimuth_deg"] = six(file.stripes_azimuth_deg);
  json["sd_m"] = six(file.stripes.sd_m);
  json["spacing_m"] = six(file.stripes.spacing_spacings * share.cell_m);
  json["corrected_cells"] = file.destriped_cells;
  return json;
}

Json band_json(const SurveyFile& file, const Share& share) {
  Json octaves = Json::array();
  for (const auto& octave : file.band.octaves)
    octaves.push_back(
        {{"from_cells", octave.from_cells}, {"to_cells", octave.to_cells}, {"exponent", six(octave.exponent)}});
  return {{"smoothed_below_cells", file.band.begins_cells > 2.0 ? file.band.begins_cells : 0.0},
          {"removed_below_cells", six(file.removed_below_cells)},
          {"band_start_m", six(band_start_m(file, share))},
          {"spectrum", octaves}};
}

Json source_json(const SurveyFile& file, const Share& share, const CellFacts& cells) {
  Json json = {{"file", file.raster->name()},
               {"band", file.options.band},
               {"crs", crs_of(file)},
               {"crs_given", !file.options.crs.empty()},
               {"columns", file.raster->columns()},
               {"rows", file.raster->rows()},
               {"cell_m", six(share.cell_m)},
               {"values", file.values.down ? "depths" : "elevations"},
               {"values_because", file.values.down_why},
               {"unit", file.values.unit},
               {"metres_per_unit", file.values.unit_m},
               {"vertical_reference", file.raster->hints().vertical},
               {"datum_shift_m", file.options.datum_shift_m},
               {"separations", file.options.vertical},
               {"posts_without_separation", share.without_datum},
               {"marked_cells", file.values.marked},
               {"lowest_m", six(file.values.lowest_m)},
               {"highest_m", six(file.values.highest_m)},
               {"surveyed_m2", six(share.surveyed_m2)},
               {"used_m2", six(share.used_m2)},
               {"lost_m2", six(lost_m2(share))}};
  if (file.points) {
    json["points"] = {{"count", file.points->points},
                      {"method", file.points->method},
                      {"cell", six(file.points->cell_m)},
                      {"cells", file.points->cells},
                      {"widest_spread_m", six(file.points->widest_spread_m)}};
  }
  json["posts_against_cells"] = {
      {"cells", cells.cells}, {"rms_m", six(cells.rms_m)}, {"largest_m", six(cells.largest_m)}};
  json["overlap"] = {{"posts", share.overlap},
                     {"mean_difference_m", six(share.overlap_mean_m)},
                     {"rms_difference_m", six(share.overlap_rms_m)}};
  json["spikes"] = spikes_json(file);
  json["stripes"] = stripes_json(file, share);
  json["band"] = band_json(file, share);
  return json;
}

Json classes_json(const ClassPosts& classes, double post_m2) {
  Json json = Json::array();
  for (std::size_t sediment = 0; sediment < classes.size(); ++sediment) {
    if (classes[sediment] > 0)
      json.push_back({{"class", sediment}, {"area_m2", six(static_cast<double>(classes[sediment]) * post_m2)}});
  }
  return json;
}

std::string source_text(const SurveyFile& file, const Share& share, const CellFacts& cells) {
  const auto& raster = *file.raster;
  std::string text =
      fmt::format("{}: {} x {} cells of {:.4g} m, {}{}\n", raster.name(), raster.columns(), raster.rows(), share.cell_m,
                  crs_of(file), file.options.crs.empty() ? "" : ", as given");
  const auto line = [&](const std::string& words) { text += "  " + words + "\n"; };
  if (file.points) {
    line(fmt::format(
        "{} points gridded ({}) into {} cells of {:.4g}; points of one cell lie up to {:.2f} m apart in height",
        file.points->points, file.points->method, file.points->cells, file.points->cell_m,
        file.points->widest_spread_m));
  }
  line(
      fmt::format("{} in {} ({}), {:.2f} to {:.2f} m up{}{}", file.values.down ? "depths" : "elevations",
                  file.values.unit, file.values.down_why, file.values.lowest_m, file.values.highest_m,
                  file.options.datum_shift_m != 0.0 ? fmt::format(", shifted by {} m", file.options.datum_shift_m) : "",
                  file.options.vertical.empty() ? "" : ", separations from " + file.options.vertical));
  if (!raster.hints().vertical.empty())
    line(fmt::format("vertical reference system {}: taken as it is, not converted", raster.hints().vertical));
  if (share.without_datum > 0) line(fmt::format("{} posts are lost: no separation there", share.without_datum));
  line(fmt::format("{} surveyed, {} used, {} lost along its rims", area(share.surveyed_m2), area(share.used_m2),
                   area(lost_m2(share))));
  if (cells.cells > 0) {
    line(fmt::format("the stored seabed is off its cells by {:.2g} m rms, at most {:.2g} m ({} of {} cells compared)",
                     cells.rms_m, cells.largest_m, cells.cells, file.known_cells));
  }
  if (share.overlap > 0) {
    line(
        fmt::format("{} posts are known to earlier files too; here they are {:+.3f} m off on the average, {:.3f} m rms",
                    share.overlap, share.overlap_mean_m, share.overlap_rms_m));
  }
  if (!file.spikes.empty()) {
    line(fmt::format("{} spikes{}", file.spikes.size(),
                     file.despiked ? ", made holes" : " (single cells; --despike makes them holes)"));
  }
  if (file.stripes.found) {
    line(fmt::format("stripes at {:.0f} deg, {:.3f} m sd{}: {}", file.stripes_azimuth_deg, file.stripes.sd_m,
                     file.stripes.spacing_spacings > 0.0
                         ? fmt::format(", every {:.3g} m", file.stripes.spacing_spacings * share.cell_m)
                         : "",
                     file.destriped_cells > 0 ? fmt::format("taken out of {} cells", file.destriped_cells)
                                              : "survey lines, or straight bedforms (--destripe takes them out)"));
  }
  if (file.band.begins_cells > 2.0)
    line(fmt::format("smoothed below {:.0f} cells ({:.3g} m)", file.band.begins_cells,
                     file.band.begins_cells * share.cell_m));
  if (file.removed_below_cells > 0.0) {
    line(fmt::format("waves shorter than {:.3g} cells ({:.3g} m) taken out", file.removed_below_cells,
                     file.removed_below_cells * share.cell_m));
  }
  return text;
}

}  // namespace

StepFacts step_facts(const Mosaic& mosaic, double lsb_m) {
  StepFacts facts{.lsb_m = lsb_m};
  double square = 0.0;
  std::int64_t known = 0;
  for (const float height : mosaic.tile().height_m) {
    if (std::isnan(height)) continue;
    const double error = std::abs(static_cast<double>(terrain::on_lattice(height, lsb_m)) - height);
    facts.largest_m = std::max(facts.largest_m, error);
    square += error * error;
    ++known;
  }
  facts.rms_m = std::sqrt(square / static_cast<double>(known));
  return facts;
}

Json report_json(const std::vector<SurveyFile>& files, const Mosaic& mosaic, const HoleFacts& holes,
                 const ClassPosts& classes, const StepFacts& steps, const std::vector<CellFacts>& cells) {
  const double post_m2 = mosaic.tile().spacing_m * mosaic.tile().spacing_m;
  const auto origin = mosaic.origin();
  const auto posts_m2 = [&](std::int64_t posts) { return six(static_cast<double>(posts) * post_m2); };
  Json sources = Json::array();
  double start_m = 0.0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    sources.push_back(source_json(files[i], mosaic.shares()[i], cells[i]));
    start_m = std::max(start_m, band_start_m(files[i], mosaic.shares()[i]));
  }
  return {
      {"ensonify", "import/1"},
      {"origin", {{"latitude_deg", origin.latitude_deg}, {"longitude_deg", origin.longitude_deg}}},
      {"map", "transverse Mercator about the origin, scale 1, WGS 84"},
      {"resampling", "bilinear between the centres of four cells; none beside a hole"},
      {"spacing_m", mosaic.tile().spacing_m},
      {"lowest_m", six(mosaic.lowest_m())},
      {"highest_m", six(mosaic.highest_m())},
      {"band_start_m", six(start_m)},
      {"steps", {{"lsb_m", steps.lsb_m}, {"largest_error_m", six(steps.largest_m)}, {"rms_error_m", six(steps.rms_m)}}},
      {"holes",
       {{"count", holes.holes},
        {"area_m2", posts_m2(holes.hole_posts)},
        {"largest_m2", six(holes.largest_m2)},
        {"largest_at_enu_m", {six(holes.largest_at_enu_m.x()), six(holes.largest_at_enu_m.y())}},
        {"filled", holes.filled},
        {"filled_m2", posts_m2(holes.filled_posts)},
        {"not_surveyed_m2", posts_m2(holes.outside_posts)}}},
      {"classes", classes_json(classes, post_m2)},
      {"sources", sources}};
}

std::string report_text(const std::vector<SurveyFile>& files, const Mosaic& mosaic, const HoleFacts& holes,
                        const ClassPosts& classes, const StepFacts& steps, const std::vector<CellFacts>& cells) {
  const auto& tile = mosaic.tile();
  const double post_m2 = tile.spacing_m * tile.spacing_m;
  const auto posts = [&](std::int64_t count) { return area(static_cast<double>(count) * post_m2); };
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i) text += source_text(files[i], mosaic.shares()[i], cells[i]);
  text += fmt::format("origin {:.6f}, {:.6f} deg; {} x {} posts {} m apart, {:.2f} to {:.2f} m up\n",
                      mosaic.origin().latitude_deg, mosaic.origin().longitude_deg, tile.columns, tile.rows,
                      tile.spacing_m, mosaic.lowest_m(), mosaic.highest_m());
  text += fmt::format("holes: {} of {} remain", holes.holes, posts(holes.hole_posts));
  if (holes.holes > 0) {
    text += fmt::format(", the largest {} at east {:.1f}, north {:.1f} m", area(holes.largest_m2),
                        holes.largest_at_enu_m.x(), holes.largest_at_enu_m.y());
  }
  if (holes.filled > 0) text += fmt::format("; {} of {} filled", holes.filled, posts(holes.filled_posts));
  text += fmt::format("; not surveyed: {} of the rectangle\n", posts(holes.outside_posts));
  text += "classes:";
  for (const auto& entry : classes_json(classes, post_m2))
    text += fmt::format(" {} on {}", entry["class"].get<int>(), area(entry["area_m2"].get<double>()));
  text += fmt::format("\nsteps of {} m: posts rounded by {:.2g} m rms, at most {:.2g} m\n", steps.lsb_m, steps.rms_m,
                      steps.largest_m);
  return text;
}

}  // namespace ensonify::terrain_import
