#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <GeographicLib/UTMUPS.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "components/config/config_error.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/terrain/raster_source.h"
#include "components/terrain/source_of.h"
#include "components/terrain_pager/mission_track.h"
#include "components/terrain_pager/node.h"

using namespace ensonify;
using namespace ensonify::pager;
using namespace ensonify::source;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kHole = -9999.0;

/// A raster made for a test: 200 x 120 cells of 2 m x 2.5 m in UTM 19 north, north up unless said otherwise.
struct MadeRaster {
  std::string name = "made.tif";
  int epsg = 32619;  // 0: none
  double geotransform[6] = {360000.0, 2.0, 0.0, 4680000.0, 0.0, -2.5};
  std::function<double(double x, double y)> height = [](double x, double y) {
    return -20.0 + 0.01 * (x - 360200.0) - 0.02 * (y - 4679850.0);
  };
  bool declare_nodata = true;

  std::string write() const {
    GDALAllRegister();
    const auto folder = std::filesystem::temp_directory_path() / "ensonify_raster_test";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    auto* file =
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 200, 120, 1, GDT_Float64, nullptr);
    file->SetGeoTransform(const_cast<double*>(geotransform));
    if (epsg != 0) {
      OGRSpatialReference reference;
      reference.importFromEPSG(epsg);
      file->SetSpatialRef(&reference);
    }
    std::vector<double> cells;
    for (int row = 0; row < 120; ++row) {
      for (int column = 0; column < 200; ++column) {
        cells.push_back(height(geotransform[0] + (column + 0.5) * geotransform[1],
                               geotransform[3] + (row + 0.5) * geotransform[5]));
      }
    }
    if (declare_nodata) file->GetRasterBand(1)->SetNoDataValue(kHole);
    REQUIRE(file->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 200, 120, cells.data(), 200, 120, GDT_Float64, 0, 0,
                                             nullptr) == CE_None);
    GDALClose(file);
    return path;
  }
};

RasterOptions options_for(const MadeRaster& raster) {
  RasterOptions options;
  options.path = raster.write();
  return options;
}

/// The message of the refusal, without the path.
std::string refusal(const RasterOptions& options) {
  try {
    RasterSource source(options, std::nullopt);
  } catch (const ConfigError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].place.file == options.path);
    return error.problems()[0].message;
  }
  return "accepted";
}

std::string shared_data() {
  const char* folder = std::getenv("ENSONIFY_SHARED");
  const std::string data = std::string(folder ? folder : "") + "/data/terrain";
  if (!std::filesystem::exists(data)) WARN("skipped: no real rasters in " << data);
  return std::filesystem::exists(data) ? data : "";
}

}  // namespace

TEST_CASE("a raster's heights stand at the right places of the world") {
  const MadeRaster raster;
  const RasterSource source(options_for(raster), std::nullopt);
  const frames::LocalProjection world(source.origin());
  // GeographicLib says where in UTM a post lies, PROJ where its height is taken: two implementations of both maps.
  for (const Vec2& place : {Vec2(0, 0), Vec2(150, -100), Vec2(-190, 120), Vec2(60.3, 7.9)}) {
    const auto geodetic = world.geodetic_of(place);
    int zone = 0;
    bool north = true;
    double x = 0, y = 0;
    GeographicLib::UTMUPS::Forward(geodetic.latitude_deg, geodetic.longitude_deg, zone, north, x, y);
    CHECK_THAT(source.height_m(place), WithinAbs(raster.height(x, y), 1e-4));
  }
}

TEST_CASE("posts of a tile carry the plane they were sampled from") {
  const MadeRaster raster;
  const RasterSource source(options_for(raster), std::nullopt);
  const PostBlock block{-300, -200, 600, 400, 0.5};
  std::vector<float> heights(block.size());
  std::vector<std::uint8_t> sediment(block.size());
  source.sample(block, heights, sediment);
  for (int k = 0; k < 40; ++k) {
    const int column = 14 * k, row = 9 * k;
    const double direct = source.height_m({block.east_m(column), block.north_m(row)});
    CHECK_THAT(heights[static_cast<std::size_t>(row * 600 + column)], WithinAbs(direct, 1e-4));
  }
}

TEST_CASE("two tiles share the bits of their common edge") {
  MadeRaster raster;
  raster.height = [](double x, double y) { return -15 + 3 * std::sin(x / 7) * std::cos(y / 11); };
  const RasterSource source(options_for(raster), std::nullopt);
  const terrain::TileGrid grid{Vec2::Zero(), 0.1, 1024, 0.0002};
  const auto west = make_tile(source, grid, {-1, 0}), east = make_tile(source, grid, {0, 0});
  const auto south = make_tile(source, grid, {0, -1});
  for (std::size_t k = 0; k <= 1024; ++k) {
    REQUIRE(west.height_m(k, 1024) == east.height_m(k, 0));
    REQUIRE(south.height_m(1024, k) == east.height_m(0, k));
  }
  REQUIRE_FALSE(std::isnan(east.height_m(0, 0)));
}

TEST_CASE("a south-up raster is read as well as a north-up one") {
  MadeRaster up, down;
  down.name = "south_up.tif";
  down.geotransform[3] = 4680000.0 - 120 * 2.5;
  down.geotransform[5] = 2.5;
  const RasterSource a(options_for(up), std::nullopt), b(options_for(down), std::nullopt);
  CHECK_THAT(a.height_m({33, 44}), WithinAbs(b.height_m({33, 44}), 1e-6));
  CHECK_THAT(a.extent().north_m, WithinAbs(b.extent().north_m, 1e-3));
}

TEST_CASE("a raster turned and sheared against its map stands where its geotransform says") {
  MadeRaster raster;
  raster.name = "turned.tif";
  raster.height = [](double, double) { return -20.0; };
  const double turned[6] = {360000.0, 1.9, 0.7, 4680000.0, 0.6, -2.3};
  std::copy(std::begin(turned), std::end(turned), raster.geotransform);
  const RasterSource source(options_for(raster), std::nullopt);
  const auto at = [&](double column, double row) {  // where UTM and the world's map place the centre of a cell
    const double c = column + 0.5, r = row + 0.5;
    double latitude = 0, longitude = 0;
    GeographicLib::UTMUPS::Reverse(19, true, turned[0] + c * turned[1] + r * turned[2],
                                   turned[3] + c * turned[4] + r * turned[5], latitude, longitude);
    return frames::LocalProjection(source.origin()).enu_of({latitude, longitude});
  };
  // A third of a cell inside and outside the corners' centres.
  for (const auto& [column, row] : {std::pair{0.0, 0.0}, {199.0, 0.0}, {0.0, 119.0}, {199.0, 119.0}}) {
    const double in = 1.0 / 3.0, to_c = column == 0.0 ? in : -in, to_r = row == 0.0 ? in : -in;
    CHECK(source.height_m(at(column + to_c, row + to_r)) == Approx(-20.0));
    CHECK(std::isnan(source.height_m(at(column - to_c, row + to_r))));
    CHECK(std::isnan(source.height_m(at(column + to_c, row - to_r))));
  }
}

TEST_CASE("a raster across the antimeridian is one seabed, in either longitude convention") {
  for (const double west_deg : {179.999, -180.001}) {
    MadeRaster raster;
    raster.name = "antimeridian.tif";
    raster.epsg = 4326;
    const double degrees[6] = {west_deg, 1e-5, 0.0, -16.0, 0.0, -1e-5};
    std::copy(std::begin(degrees), std::end(degrees), raster.geotransform);
    raster.height = [&](double x, double) { return -20.0 + 1000.0 * (x - west_deg); };  // 2 m over 200 cells
    const RasterSource source(options_for(raster), std::nullopt);
    CHECK(source.extent().east_m - source.extent().west_m == Approx(199 * 1e-5 * 107036).epsilon(1e-3));
    CHECK_THAT(source.height_m({-100, 0}), WithinAbs(-19.0 - 1000.0 * 100.0 / 107036, 1e-3));
    CHECK_THAT(source.height_m({100, 0}), WithinAbs(-19.0 + 1000.0 * 100.0 / 107036, 1e-3));
  }
}

TEST_CASE("holes stay holes, or are filled when asked") {
  MadeRaster raster;
  const auto plane = raster.height;
  raster.height = [&](double x, double y) {
    return std::hypot(x - 360200.0, y - 4679850.0) < 12.0 ? kHole : plane(x, y);
  };
  auto options = options_for(raster);
  CHECK(std::isnan(RasterSource(options, std::nullopt).height_m({0, 0})));
  options.fill_holes = true;
  options.fill_distance_cells = 50;
  const RasterSource filled(options, std::nullopt);
  CHECK_THAT(filled.height_m({0, 0}), WithinAbs(-20.0, 0.3));
  CHECK(filled.height_m({100, 0}) == Approx(RasterSource(options_for(MadeRaster{}), std::nullopt).height_m({100, 0})));
}

TEST_CASE("depths are turned when declared, and refused when not") {
  MadeRaster raster;
  raster.height = [](double, double) { return 12.5; };
  auto options = options_for(raster);
  CHECK(refusal(options) ==
        "is mostly above the water (heights from 12.5 to 12.5 m up): its values are depths or land; "
        "`seabed.raster.values: depth` reads them as depths, land alone cannot be surveyed");
  options.values_are_depths = true;
  CHECK(RasterSource(options, std::nullopt).height_m({0, 0}) == Approx(-12.5));

  MadeRaster elevations;
  elevations.height = [](double, double) { return -12.5; };
  auto turned = options_for(elevations);
  turned.values_are_depths = true;
  const std::string advice =
      "is mostly above the water (heights from 12.5 to 12.5 m up): its values are elevations or land; "
      "`seabed.raster.values: elevation` reads them as such, land alone cannot be surveyed";
  CHECK(refusal(turned) == advice);
  turned.fill_holes = true;
  CHECK(refusal(turned) == advice);
}

TEST_CASE("rasters that cannot be trusted are refused with cause and remedy") {
  MadeRaster raster;
  SECTION("not a raster") {
    RasterOptions options;
    options.path = __FILE__;
    CHECK(refusal(options).find("any format that GDAL reads is allowed: GeoTIFF") != std::string::npos);
  }
  SECTION("no file") {
    RasterOptions options;
    options.path = "nowhere.tif";
    CHECK(refusal(options).find("cannot be read as a raster (nowhere.tif: No such file or directory)") == 0);
  }
  SECTION("no reference system") {
    raster.epsg = 0;
    auto options = options_for(raster);
    CHECK(refusal(options) == "has no coordinate reference system; name it with the pager's `raster_crs: EPSG:...`");
    options.crs = "EPSG:32619";
    CHECK(refusal(options) == "accepted");
  }
  SECTION("squeezed to nothing") {
    raster.geotransform[2] = -2.0;
    raster.geotransform[4] = 2.5;
    CHECK(refusal(options_for(raster)) == "has a geotransform that squeezes its cells to nothing");
  }
  SECTION("degrees over half a continent") {
    raster.epsg = 4326;
    const double degrees[6] = {-70.0, 0.1, 0.0, 45.0, 0.0, -0.1};
    std::copy(std::begin(degrees), std::end(degrees), raster.geotransform);
    raster.height = [](double, double) { return -20.0; };
    CHECK(refusal(options_for(raster)).find("at most 200 km x 200 km are allowed") != std::string::npos);
  }
  SECTION("nothing but holes") {
    raster.height = [](double, double) { return kHole; };
    CHECK(refusal(options_for(raster)) == "holds no valid cell: all are nodata or NaN");
  }
  SECTION("undeclared nodata") {
    raster.height = [](double x, double) { return x < 360100 ? kHole : -20.0; };
    raster.declare_nodata = false;
    auto options = options_for(raster);
    CHECK(refusal(options) ==
          "holds -9999, which looks like a mark for missing values but is not declared as one; set the pager's "
          "`raster_nodata: -9999`");
    options.nodata = kHole;
    CHECK(refusal(options) == "accepted");
  }
  SECTION("no such band") {
    auto options = options_for(raster);
    options.band = 3;
    CHECK(refusal(options) == "has no band 3; allowed are 1 to 1");
  }
}

TEST_CASE("a small geographic raster is reprojected, degrees never taken for metres") {
  MadeRaster raster;
  raster.epsg = 4326;
  const double degrees[6] = {-70.0, 2e-5, 0.0, 45.0, 0.0, -2e-5};
  std::copy(std::begin(degrees), std::end(degrees), raster.geotransform);
  raster.height = [](double x, double) { return -20.0 + 1000.0 * (x + 69.998); };
  const RasterSource source(options_for(raster), std::nullopt);
  // 200 cells of 2e-5 degrees at 45 degrees north: 199 x 2e-5 x 78,847 m per degree of longitude.
  CHECK(source.extent().east_m - source.extent().west_m == Approx(199 * 2e-5 * 78847).epsilon(1e-3));
  CHECK(source.height_m({50, 0}) == Approx(-20.0 + 1000.0 * 50.0 / 78847).epsilon(1e-4));
}

TEST_CASE("runlines must lie on the terrain, and their corridor must be known") {
  MadeRaster raster;
  const auto plane = raster.height;
  raster.height = [&](double x, double y) {
    return std::hypot(x - 360230.0, y - 4679850.0) < 9.0 ? kHole : plane(x, y);
  };
  const RasterSource source(options_for(raster), std::nullopt);
  const auto problem = [&](const Vec2& from, const Vec2& to, bool refuse_holes = true) {
    try {
      check_corridors(source,
                      {{.line = {from, to}, .place = {"bay.yaml", 0, 0}, .key = "mission runline 1", .surveyed = true}},
                      {.refuse_holes = refuse_holes});
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(problem({-100, 90}, {100, 90}) == "accepted");
  CHECK(problem({-100, 90}, {300, 90})
            .find("bay.yaml: mission runline 1: its end (300.0, 90.0) m is outside the terrain; "
                  "allowed is east -") == 0);
  const auto hole = problem({-100, 30}, {100, 30});  // 30 m beside the hole, 43 m of swath
  CHECK(hole.find("inside the surveyed corridor; move the line, or set seabed.raster.holes to keep or fill") !=
        std::string::npos);
  CHECK(problem({-100, 30}, {100, 30}, false) == "accepted");
}

TEST_CASE("a chart has at most 256 posts a side, the origin and the range of depths") {
  const RasterSource source(options_for(MadeRaster{}), std::nullopt);
  const auto chart = make_chart(source, source.overview());
  CHECK(chart.height_m.rows() <= 256);
  CHECK(chart.height_m.cols() >= 255);
  CHECK(chart.height_m.cols() <= 256);
  CHECK_THAT(chart.origin_latitude_deg, WithinAbs(42.26, 0.02));
  CHECK_THAT(chart.deepest_m, WithinAbs(20 + 0.01 * 199 + 0.02 * 148.75, 1e-3));
  CHECK_THAT(
      chart.height_m(100, 100),
      WithinAbs(source.height_m({chart.west_m + 100 * chart.spacing_m, chart.south_m + 100 * chart.spacing_m}), 1e-4));
}

TEST_CASE("real rasters of every container are read to the same seabed") {
  const std::string data = shared_data();
  if (data.empty()) return;
  for (const std::string name : {"clip.tif", "clip.asc", "clip.nc", "clip.bag"}) {
    RasterOptions options;
    options.path = data + "/formats/" + name;
    const RasterSource source(options, std::nullopt);
    INFO(name);
    CHECK_THAT(source.lowest_m(), WithinAbs(-25.17, 1e-3));
    CHECK_THAT(source.highest_m(), WithinAbs(-11.88, 1e-3));
    CHECK_THAT(source.native_spacing_m(), WithinAbs(5.0, 0.02));
    CHECK(std::isfinite(source.height_m({100, 100})));
  }
  for (const std::string name : {"massbay_5m.tif", "bering_jd211_2m.bag", "bedford_depth_9m.tif",
                                 "horseshoe_reef_1cm.tif", "f00788_8m.bag", "f00788_8m.tif"}) {
    RasterOptions options;
    options.path = data + "/" + name;
    INFO(name);
    CHECK(refusal(options) == "accepted");
  }
}

TEST_CASE("real rasters with real faults are refused") {
  const std::string data = shared_data();
  if (data.empty()) return;
  RasterOptions options;
  options.path = data + "/german_bight_1km.nc";  // degrees without a reference system, depths positive down
  CHECK(refusal(options) == "has no coordinate reference system; name it with the pager's `raster_crs: EPSG:...`");
  options.crs = "EPSG:4326";
  CHECK(refusal(options).find("`seabed.raster.values: depth` reads them as depths") != std::string::npos);
  options.path = data + "/formats/clip.xyz";
  options.crs = "EPSG:32619";
  CHECK(refusal(options).find("set the pager's `raster_nodata: -9999`") != std::string::npos);
}

TEST_CASE("tiles state their facets' slopes, also with a mask of the guide's shape") {
  // -20 m in the middle; within 250 m x 200 m of it the ground lies between 16.75 and 23.25 m.
  const MadeRaster raster;
  TerrainPagerConfig config;
  config.feed_margin_m = 20.0;
  config.terrain.site.origin = RasterSource(options_for(raster), std::nullopt).origin();
  Seabed& seabed = config.terrain.seabed;
  seabed.post_spacing_m = 0.25;
  seabed.layered.size_m = {250.0, 200.0};
  seabed.sediments = {{0, *seabed::sediment_of("medium silt")}, {2, *seabed::sediment_of("medium sand")}};
  layers::Guide guide;
  guide.raster = raster.write();
  guide.cell_m = 5.0;
  const relief::Spectrum relief{.rms_m = 0.01, .hurst = 0.625, .outer_scale_m = 20.0};
  const auto reported = [&](const std::optional<layers::Mask>& mask) {
    seabed.layered.layers = {{.name = "ground", .form = guide},
                             {.name = "silt", .form = layers::Spectral{.spectrum = relief}, .mask = mask}};
    NodeUnderTest<TerrainPagerNode> pager(config);
    pager.give("pose", msg::Pose{}, msg::Pose{.stamp_ns = 1'000'000'000});
    const auto tiles = pager.step_until<msg::Tile>("tile", 1_s);
    REQUIRE_FALSE(tiles.empty());
    for (const msg::Tile& tile : tiles) CHECK(tile.facet_mean_square_slope == tiles[0].facet_mean_square_slope);
    const auto slopes = tiles[0].facet_mean_square_slope.flat();
    return std::vector<double>(slopes.begin(), slopes.end());
  };
  const auto in_depths = [](double from_m, double to_m) {
    layers::Mask mask;
    mask.depth_m = relief::Band{.low = from_m, .high = to_m};
    mask.of = "ground";
    return mask;
  };
  const auto everywhere = reported(std::nullopt);
  REQUIRE(everywhere.size() == 3);
  // Rounded to 1e-4 degrees: of a slope of 0.9 degrees 1e-4, of its square twice that.
  CHECK(everywhere[0] == Approx(relief::facet_mean_square_slope(relief, 0.25)).epsilon(2e-4));
  CHECK(everywhere[1] == 0.0);
  CHECK(everywhere[2] == everywhere[0]);
  CHECK(reported(in_depths(0.0, 21.0)) == everywhere);  // at three quarters of the places
  CHECK(reported(in_depths(0.0, 19.0)).empty());        // at a quarter

  config.terrain.seabed.kind = Seabed::Kind::kRaster;  // nobody knows what its heights are made of
  config.terrain.seabed.raster.path = guide.raster;
  CHECK(reported(std::nullopt).empty());
}
