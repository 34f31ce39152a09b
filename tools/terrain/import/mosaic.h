#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "components/terrain/terrain_source.h"
#include "kernels/survey/grid/defects.h"
#include "tools/terrain/import/survey_file.h"

namespace ensonify::terrain_import {

/// Contribution of one file to the whole.
struct Share {
  double cell_m = 0.0;             // the shorter side of its cells in the world
  double surveyed_m2 = 0.0;        // its cells that hold a value
  double known_m2 = 0.0;           // posts whose height it knows, by their own area
  double used_m2 = 0.0;            // posts that took it
  std::int64_t without_datum = 0;  // posts lost because the raster of its datum has no value there
  std::int64_t overlap = 0;        // posts that an earlier file decided and it knows as well
  double overlap_mean_m = 0.0;     // its height there less the one that was taken
  double overlap_rms_m = 0.0;
};

/// All files on one lattice of posts about one origin.
class Mosaic : public source::TerrainSource {
 public:
  /// Throws UserError when posts are too many or when no file knows any.
  Mosaic(std::vector<SurveyFile>& files, const ImportOptions& options);

  source::Extent extent() const override;
  double lowest_m() const override { return lowest_m_; }
  double highest_m() const override { return highest_m_; }
  frames::Geodetic origin() const override { return origin_; }
  double native_spacing_m() const override { return tile_.spacing_m; }
  void sample(const source::PostBlock& posts, std::span<float> height_m,
              std::span<std::uint8_t> sediment) const override;
  double height_m(const frames::Vec2& place) const override;

  const std::vector<Share>& shares() const { return shares_; }
  /// The posts, as a tile that holds them all; heights and classes may be changed.
  terrain::Tile& tile() { return tile_; }
  const terrain::Tile& tile() const { return tile_; }
  /// The tile's first post, counted from the origin.
  std::int64_t first_east() const { return first_east_; }
  std::int64_t first_north() const { return first_north_; }
  source::PostBlock rows(int first, int count) const;

 private:
  void place_origin(const std::vector<SurveyFile>& files, const ImportOptions& options);
  void lay_posts(const std::vector<SurveyFile>& files, double spacing_m);
  void add(const SurveyFile& file, Share& share);
  void measure();

  frames::Geodetic origin_;
  source::Extent surveyed_;
  terrain::Tile tile_;
  std::int64_t first_east_ = 0, first_north_ = 0;
  double lowest_m_ = 0.0, highest_m_ = 0.0;
  std::vector<Share> shares_;
};

/// The posts without a height, after filling.
struct HoleFacts {
  std::int64_t holes = 0, hole_posts = 0;                // inside the survey
  std::int64_t filled = 0, filled_posts = 0;             // more of them that were filled
  std::int64_t outside_posts = 0;                        // ground of the rectangle that was not surveyed
  double largest_m2 = 0.0;                               // of the holes that remain
  frames::Vec2 largest_at_enu_m = frames::Vec2::Zero();  // a post of that
};

/// Finds the holes of the mosaic and fills those that reach no farther than asked for. Throws UserError.
HoleFacts fill(Mosaic& mosaic, const FillOptions& options);

/// Number of posts of each class; holes count for none.
using ClassPosts = std::array<std::int64_t, 256>;

/// Gives each post of the mosaic its sediment class: from the class raster (nearest cell), else from the backscatter
/// raster (interpolated, by thresholds), else from the first rule that holds, else the class of all others. Depths and
/// slopes are those of the posts, the slope that over one post to either side. Throws UserError.
ClassPosts classify(Mosaic& mosaic, const SedimentOptions& options);

inline constexpr const char* kReport = "import.json";

/// Effect of whole steps on the heights.
struct StepFacts {
  double lsb_m = 0.0;
  double largest_m = 0.0, rms_m = 0.0;  // errors
};
StepFacts step_facts(const Mosaic& mosaic, double lsb_m);

/// How far the seabed as it is stored lies from the cells of a file, at their middles: what resampling, smoothing,
/// removed artefacts and steps do together. Of the file's kept_cells those that no better file decides and that posts
/// surround.
struct CellFacts {
  std::int64_t cells = 0;
  double largest_m = 0.0, rms_m = 0.0;
};
/// One for each file. Throws ConfigError for a raster of separations that cannot be read.
std::vector<CellFacts> cell_facts(const std::vector<SurveyFile>& files, const Mosaic& mosaic,
                                  const ImportOptions& options, double lsb_m);

/// Everything that an import did and lost: sources, reference systems, resampling, areas, holes, artefacts, steps.
nlohmann::ordered_json report_json(const std::vector<SurveyFile>& files, const Mosaic& mosaic, const HoleFacts& holes,
                                   const ClassPosts& classes, const StepFacts& steps,
                                   const std::vector<CellFacts>& cells);

/// The same for people, some lines.
std::string report_text(const std::vector<SurveyFile>& files, const Mosaic& mosaic, const HoleFacts& holes,
                        const ClassPosts& classes, const StepFacts& steps, const std::vector<CellFacts>& cells);

}  // namespace ensonify::terrain_import
