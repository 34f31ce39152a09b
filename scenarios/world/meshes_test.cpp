#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "components/config/config_reader.h"
#include "scenarios/world/seabed.h"
#include "scenarios/world/testing/sections.h"

namespace ensonify {
namespace {

Seabed seabed_of(const std::string& text) {
  auto from = ConfigReader::from_text(text, "s.yaml");
  Seabed seabed = read_seabed(from.section("seabed"));
  from.finish();
  return seabed;
}

std::string problems_of(const std::string& text) {
  try {
    seabed_of(text);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("meshes of a seabed are read: of a file, or a wall of sheet piles") {
  const Seabed seabed = seabed_of(R"(seabed:
  kind: layers
  sediments: {4: {lambert_mu_db: -12}}
  meshes:
    quay: {sheet_pile_wall: {from_m: [-50, 2], to_m: [50, 2], foot_depth_m: 14, profile_depth_m: 0.36}, sediment: 4}
    hill: {file: /etc/hostname, unit_m: 0.001, position_m: [3, 4, -5], heading_deg: 90, up: y, tilt_deg: 30, tilt_heading_deg: 180}
)");
  REQUIRE(seabed.meshes.size() == 2);
  const SeabedMesh &quay = seabed.meshes[0], &hill = seabed.meshes[1];
  CHECK(quay.name == "quay");
  REQUIRE(quay.wall);
  CHECK(quay.wall->to_enu_m == frames::Vec2(50, 2));
  CHECK(quay.wall->foot_depth_m == 14);
  CHECK(quay.wall->profile_depth_m == 0.36);
  CHECK(quay.sediment == 4);
  CHECK_FALSE(hill.wall);
  CHECK(hill.file == "/etc/hostname");
  CHECK(hill.unit_m == 0.001);
  CHECK(hill.position_enu_m == frames::Vec3(3, 4, -5));
  CHECK(hill.heading_rad == Approx(std::numbers::pi / 2));
  CHECK(hill.up == SeabedMesh::Up::kY);
  CHECK(hill.tilt_rad == Approx(std::numbers::pi / 6));
  CHECK(hill.tilt_heading_rad == Approx(std::numbers::pi));
}

TEST_CASE("meshes of bars, and copies of meshes, are read") {
  const Seabed seabed = seabed_of(R"(seabed:
  kind: layers
  meshes:
    jetty:
      bars:
        - {from_m: [0, 0, -9], to_m: [0, 0, 0], diameter_m: 0.6, repeat: [{count: 8, step_m: [0, 4, 0]}, {count: 2, step_m: [3, 0, 0]}]}
        - {from_m: [0, 1, -4], to_m: [0, 1, 0], section_m: [0.3, 0.4]}
      position_m: [10, 20, -1]
      heading_deg: 90
    stones:
      file: /etc/hostname
      unit_m: 0.01
      strewn: {count: 30, from_m: [-5, 0], to_m: [5, 0], width_m: 4, scale: [0.3, 1.1], size_exponent: 2.5, on: [0, 3]}
)");
  REQUIRE(seabed.meshes.size() == 2);
  const SeabedMesh &jetty = seabed.meshes[0], &stones = seabed.meshes[1];
  REQUIRE(jetty.bars.size() == 2);
  CHECK(jetty.bars[0].from_m == frames::Vec3(0, 0, -9));
  CHECK(jetty.bars[0].diameter_m == 0.6);
  REQUIRE(jetty.bars[0].repeat.size() == 2);
  CHECK(jetty.bars[0].repeat[0].count == 8);
  CHECK(jetty.bars[0].repeat[1].step_m == frames::Vec3(3, 0, 0));
  CHECK(jetty.bars[1].section_m == frames::Vec2(0.3, 0.4));
  CHECK(jetty.position_enu_m == frames::Vec3(10, 20, -1));
  CHECK(jetty.heading_rad == Approx(std::numbers::pi / 2));
  CHECK_FALSE(jetty.strewn);
  REQUIRE(stones.strewn);
  CHECK(stones.unit_m == 0.01);
  CHECK(stones.strewn->count == 30);
  CHECK(stones.strewn->place == ConfigPlace{"s.yaml", 13, 15});
  CHECK(stones.strewn->on == std::vector<std::uint8_t>{0, 3});
  const progressive::Strewn& where = stones.strewn->where;
  CHECK(where.from_enu_m == frames::Vec2(-5, 0));
  CHECK(where.to_enu_m == frames::Vec2(5, 0));
  CHECK(where.width_m == 4);
  CHECK(where.least_scale == 0.3);
  CHECK(where.most_scale == 1.1);
  CHECK(where.size_exponent == 2.5);
}

TEST_CASE("mistakes in bars and copies have a place") {
  const auto of = [](const std::string& mesh) {
    return problems_of("seabed: {kind: layers, meshes: {a: {" + mesh + "}}}");
  };
  const std::string bar = "bars: [{from_m: [0, 0, 0], to_m: [0, 0, 3], ",
                    strewn = "], strewn: {count: 3, from_m: [0, 0], to_m: [9, 0]";
  CHECK(of(bar + "diameter_m: 1}]") == "");
  CHECK(of(bar + "diameter_m: 1}" + strewn + ", width_m: 2}") == "");
  CHECK(of(bar + "}]") == "s.yaml:1:44: seabed.meshes.a.bars[0]: needs one of diameter_m, section_m");
  CHECK(of(bar + "diameter_m: 1, section_m: [1, 1]}]") ==
        "s.yaml:1:44: seabed.meshes.a.bars[0]: needs one of diameter_m, section_m");
  CHECK_THAT(of("bars: [{from_m: [0, 0, 3], to_m: [0, 0, 3], diameter_m: 1}]"),
             Catch::EndsWith("seabed.meshes.a.bars[0].to_m: is less than 1 mm from from_m"));
  CHECK(of("bars: []") == "s.yaml:1:43: seabed.meshes.a.bars: is empty; at least one bar is needed");
  CHECK_THAT(of(bar + "diameter_m: 1, repeat: [{count: 0, step_m: [1, 0, 0]}]}]"),
             Catch::EndsWith("seabed.meshes.a.bars[0].repeat[0].count: 0 is outside [1, 10000]"));
  CHECK_THAT(of(bar + "diameter_m: 1, repeat: [{count: 9999, step_m: [1, 0, 0]}, {count: 99, step_m: [0, 1, 0]}]}]"),
             Catch::EndsWith("seabed.meshes.a.bars: makes 49495050 vertices; allowed: 500000"));
  CHECK_THAT(of(bar + "diameter_m: 1}" + strewn + ", width_m: 2, scale: [2, 1]}"),
             Catch::EndsWith("seabed.meshes.a.strewn.scale: falls; allowed is [least, most]"));
  CHECK_THAT(of(bar + "diameter_m: 1}" + strewn + ", width_m: 2, on: [1.5]}"),
             Catch::EndsWith("seabed.meshes.a.strewn.on: holds a number that is not a class, a whole number"));
  CHECK_THAT(of(bar + "diameter_m: 1}" + strewn + ", width_m: 2}, position_m: [0, 0, 0]"),
             Catch::Contains("seabed.meshes.a.position_m: is not a known key"));
}

TEST_CASE("mistakes in meshes have a place") {
  const auto of = [](const std::string& mesh) {
    return problems_of("seabed: {kind: layers, meshes: {a: {" + mesh + "}}}");
  };
  const std::string wall = "sheet_pile_wall: {from_m: [0, 0], to_m: [9, 0]";
  CHECK(of(wall + "}") == "");
  CHECK(of("sediment: 0") == "s.yaml:1:36: seabed.meshes.a: needs one of file, bars, sheet_pile_wall");
  CHECK_THAT(of("file: /etc/hostname, " + wall + "}"),
             Catch::StartsWith("s.yaml:1:36: seabed.meshes.a: needs one of file, bars, sheet_pile_wall"));
  CHECK(of("file: no.obj") ==
        "s.yaml:1:43: seabed.meshes.a.file: \"no.obj\": no such file or folder (searched beside this file and in the "
        "data "
        "folders)");
  CHECK(of(wall + "}, sediment: 9") == "s.yaml:1:96: seabed.meshes.a.sediment: is not a class of seabed.sediments");
  CHECK_THAT(of("sheet_pile_wall: {from_m: [0, 0], to_m: [0.2, 0]}"),
             Catch::EndsWith("to_m: is less than a pile's width from from_m"));
  CHECK_THAT(of(wall + ", foot_depth_m: 5, top_height_m: -5}"),
             Catch::EndsWith("top_height_m: is not above the foot; allowed: at least 0.1 m above it"));
  CHECK_THAT(of("sheet_pile_wall: {from_m: [0, 0], to_m: [90000, 0], row_m: 0.1}"),
             Catch::EndsWith("row_m: makes 45300302 vertices; allowed: 500000"));
  CHECK_THAT(of(wall + ", pile_width_m: .nan}"), Catch::Contains("seabed.meshes.a.sheet_pile_wall.pile_width_m: .nan"));
  CHECK_THAT(of(wall + "}, unit_m: 2"), Catch::Contains("seabed.meshes.a.unit_m: is not a known key"));
}

}  // namespace ensonify
