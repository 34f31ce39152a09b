#include "tools/console/relief.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "components/record/reader.h"
#include "kernels/base/frames/local_projection.h"
#include "messages/codec.h"

namespace ensonify::console {

namespace {

namespace fs = std::filesystem;

constexpr int kMostMessages = 5000;  // at the start of a record
constexpr std::chrono::seconds kStart{1};
constexpr int kRounds = 6;
constexpr int kMostRecords = 8;  // of a folder

/// Heights of a chart by row (north) and column (east).
class Posts {
 public:
  explicit Posts(const msg::Chart& chart) : chart_(chart) {}

  int rows() const { return static_cast<int>(chart_.height_m.rows()); }
  int columns() const { return static_cast<int>(chart_.height_m.cols()); }
  double height(int row, int column) const {
    return chart_.height_m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
  }
  double east_m(double column) const { return chart_.west_m + column * chart_.spacing_m; }
  double north_m(double row) const { return chart_.south_m + row * chart_.spacing_m; }

 private:
  const msg::Chart& chart_;
};

/// As frames::LocalProjection, in the words of PROJ.
std::string projection_of(const frames::Geodetic& origin) {
  return fmt::format("+proj=tmerc +lat_0={:.12f} +lon_0={:.12f} +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs",
                     origin.latitude_deg, origin.longitude_deg);
}

double slope(double before_m, double here_m, double after_m, double spacing_m) {
  if (std::isfinite(before_m) && std::isfinite(after_m)) return (after_m - before_m) / (2.0 * spacing_m);
  if (std::isfinite(after_m)) return (after_m - here_m) / spacing_m;
  return std::isfinite(before_m) ? (here_m - before_m) / spacing_m : 0.0;
}

std::uint8_t shade_at(const Posts& posts, int row, int column, double spacing_m) {
  const double here_m = posts.height(row, column);
  if (!std::isfinite(here_m)) return 0;
  const auto at = [&](int r, int c) {
    const bool inside = r >= 0 && c >= 0 && r < posts.rows() && c < posts.columns();
    return inside ? posts.height(r, c) : std::nan("");
  };
  const double east = kReliefExaggeration * slope(at(row, column - 1), here_m, at(row, column + 1), spacing_m);
  const double north = kReliefExaggeration * slope(at(row - 1, column), here_m, at(row + 1, column), spacing_m);
  // The normal (-east, -north, 1) times the direction to the light (-1/2, 1/2, sqrt 1/2).
  const double cosine = (0.5 * east - 0.5 * north + std::sqrt(0.5)) / std::sqrt(east * east + north * north + 1.0);
  return static_cast<std::uint8_t>(std::lround(1.0 + 254.0 * std::fmax(0.0, cosine)));
}

/// Where a contour enters and leaves a triangle of three posts: a plane, so that it is straight and never branches.
void add_piece(const std::array<std::array<double, 3>, 3>& corner, double height_m, std::vector<float>& out) {
  std::vector<float> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = corner[i];
    const auto& b = corner[(i + 1) % 3];
    if ((a[2] < height_m) == (b[2] < height_m)) continue;
    const double part = (height_m - a[2]) / (b[2] - a[2]);
    ends.push_back(static_cast<float>(a[0] + part * (b[0] - a[0])));
    ends.push_back(static_cast<float>(a[1] + part * (b[1] - a[1])));
  }
  if (ends.size() == 4) out.insert(out.end(), ends.begin(), ends.end());
}

void add_contours(const Posts& posts, double step_m, msg::ConsoleRelief& relief) {
  std::vector<float> pieces, depths;
  const auto corner = [&](int row, int column) {
    return std::array<double, 3>{posts.east_m(column), posts.north_m(row), posts.height(row, column)};
  };
  for (int row = 0; row + 1 < posts.rows(); ++row) {
    for (int column = 0; column + 1 < posts.columns(); ++column) {
      const auto sw = corner(row, column), se = corner(row, column + 1), nw = corner(row + 1, column),
                 ne = corner(row + 1, column + 1);
      for (const auto& triangle : {std::array{sw, se, ne}, std::array{sw, ne, nw}}) {
        const double low = std::min({triangle[0][2], triangle[1][2], triangle[2][2]});
        const double high = std::max({triangle[0][2], triangle[1][2], triangle[2][2]});
        if (!std::isfinite(low + high + triangle[0][2] + triangle[1][2] + triangle[2][2])) continue;
        for (double k = std::ceil(low / step_m); k * step_m <= high && depths.size() < kMostContourPieces; ++k) {
          add_piece(triangle, k * step_m, pieces);
          while (depths.size() < pieces.size() / 4) depths.push_back(static_cast<float>(-k * step_m));
        }
      }
    }
  }
  relief.contour_m = msg::Array<float>({depths.size(), 4});
  std::copy(pieces.begin(), pieces.end(), relief.contour_m.flat().begin());
  relief.contour_depth_m = msg::Array<float>::of(std::move(depths));
}

std::optional<msg::Chart> chart_in_record(const std::string& file) {
  record::RecordReader reader(file);
  record::RecordedMessage message;
  std::optional<SimTime> began;
  for (int i = 0; i < kMostMessages && reader.next(message); ++i) {
    if (!began) began = message.t_sim;
    if (message.t_sim - *began > kStart) break;
    if (message.channel->type != msg::Chart::kType) continue;
    msg::Chart chart;
    msg::from_value(msg::decode_inline(message.payload), chart, "");
    return chart;
  }
  return std::nullopt;
}

}  // namespace

double contour_step(double range_m) {
  if (!(range_m > 0.0) || !std::isfinite(range_m)) return 1.0;
  const double wanted_m = range_m / 10.0;
  const double decade_m = std::pow(10.0, std::floor(std::log10(wanted_m) + 1e-9));
  for (const double step : {1.0, 2.0, 5.0})
    if (wanted_m <= step * decade_m * (1.0 + 1e-9)) return step * decade_m;
  return 10.0 * decade_m;
}

msg::ConsoleRelief relief_of(const msg::Chart& chart) {
  msg::ConsoleRelief relief;
  relief.projection = projection_of({chart.origin_latitude_deg, chart.origin_longitude_deg});
  relief.west_m = chart.west_m;
  relief.south_m = chart.south_m;
  relief.spacing_m = chart.spacing_m;
  relief.exaggeration = kReliefExaggeration;
  if (!(chart.spacing_m > 0.0)) return relief;
  const Posts posts(chart);
  relief.shade = msg::Array<std::uint8_t>({chart.height_m.rows(), chart.height_m.cols()});
  for (int row = 0; row < posts.rows(); ++row)
    for (int column = 0; column < posts.columns(); ++column)
      relief.shade(static_cast<std::size_t>(row), static_cast<std::size_t>(column)) =
          shade_at(posts, row, column, chart.spacing_m);
  relief.contour_step_m = contour_step(chart.deepest_m - chart.shallowest_m);
  add_contours(posts, relief.contour_step_m, relief);
  return relief;
}

std::optional<msg::ConsoleRelief> map_of(const msg::Position& position) {
  frames::Geodetic origin{position.latitude_deg, position.longitude_deg};
  if (origin.latitude_deg == 0.0 && origin.longitude_deg == 0.0) return std::nullopt;
  const frames::Vec2 place_m{position.position_enu_m[0], position.position_enu_m[1]};
  try {
    // The origin from which that place has these degrees: each round corrects it by what is wrong there.
    for (int round = 0; round < kRounds; ++round) {
      const frames::Geodetic found = frames::LocalProjection(origin).geodetic_of(place_m);
      origin.latitude_deg += position.latitude_deg - found.latitude_deg;
      origin.longitude_deg += position.longitude_deg - found.longitude_deg;
    }
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  msg::ConsoleRelief map;
  map.projection = projection_of(origin);
  return map;
}

std::optional<msg::Chart> chart_in(const std::string& file_or_folder) {
  std::error_code error;
  std::vector<std::string> files;
  if (fs::is_directory(file_or_folder, error)) {
    for (fs::directory_iterator it(file_or_folder, error); !error && it != fs::directory_iterator();
         it.increment(error))
      if (it->path().extension() == ".mcap" && it->is_regular_file(error) && files.size() < kMostRecords)
        files.push_back(it->path().string());
  } else if (!file_or_folder.empty()) {
    files.push_back(file_or_folder);
  }
  for (const std::string& file : files) {
    try {
      if (auto chart = chart_in_record(file)) return chart;
    } catch (const std::exception&) {
      continue;  // being written, or none of ours
    }
  }
  return std::nullopt;
}

}  // namespace ensonify::console
