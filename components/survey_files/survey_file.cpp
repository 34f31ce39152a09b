#include "components/survey_files/survey_file.h"

#include "components/formats/recognise.h"

namespace ensonify::survey_files {

frames::Vec2 on_map(const frames::LocalProjection& projection, const frames::Vec2& reference,
                    const frames::Vec2& away_true) {
  const double turn_rad = projection.convergence_rad(reference);
  const frames::Vec2 on_grid(std::cos(turn_rad) * away_true.x() - std::sin(turn_rad) * away_true.y(),
                             std::sin(turn_rad) * away_true.x() + std::cos(turn_rad) * away_true.y());
  return reference + on_grid;
}

Summary place_soundings(const std::string& file, const Trace& trace, const TakePlaced& take) {
  formats::Window window(file);
  const formats::Format format = formats::recognise(window);
  if (format == formats::Format::kmall) return place_kmall(file, trace, take);
  if (format == formats::Format::all) return place_all(file, trace, take);
  throw UserError(file + ": is neither a .kmall nor a .all file; these are allowed");
}

bool is_survey_file(const std::string& file) {
  formats::Window window(file);
  const formats::Format format = formats::recognise(window);
  return format == formats::Format::kmall || format == formats::Format::all;
}

}  // namespace ensonify::survey_files
