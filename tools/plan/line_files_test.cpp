#include "tools/plan/line_files.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "components/errors/exit_error.h"

using namespace ensonify;
using namespace ensonify::plan;
using Catch::WithinAbs;

namespace {

std::string written(const std::string& name, const std::string& text) {
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_plan_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}

std::string refused(const std::string& name, const std::string& text, const std::string& crs = "") {
  try {
    read_lines(written(name, text), crs);
    return "accepted";
  } catch (const UserError& error) {
    const std::string why = error.what();
    return why.substr(why.find(name));
  }
}

const std::string kLnw =
    "LNS 2\r\nLIN 2\r\nPTS 465000.00 5895000.00\r\nPTS 465000.00 5896000.00\r\nLNN 1_main\r\nEOL\r\n"
    "LIN 3\r\nPTS 465100 5896000\r\nPTS 465100 5895500\r\nPTS 465150 5895000\r\nLNN 2\r\nEOL\r\n";

}  // namespace

TEST_CASE("Hypack lines are world metres, or geodetic with their reference system") {
  const LineSet metres = read_lines(written("a.lnw", kLnw), "");
  CHECK_FALSE(metres.geodetic);
  REQUIRE(metres.lines.size() == 2);
  CHECK(metres.lines[0].name == "1_main");
  CHECK(metres.lines[1].places.size() == 3);
  CHECK(metres.lines[1].places[2] == std::array<double, 2>{465150, 5895000});

  const LineSet placed = read_lines(written("a.lnw", kLnw), "EPSG:32629");
  CHECK(placed.geodetic);
  // UTM zone 29, central meridian 9 degrees west: 35 km west of it at 53.2 degrees north.
  CHECK_THAT(placed.lines[0].places[0][0], WithinAbs(53.204, 0.002));
  CHECK_THAT(placed.lines[0].places[0][1], WithinAbs(-9.524, 0.002));
}

TEST_CASE("Hypack records after a line's positions are skipped, others reported by line") {
  CHECK(
      read_lines(written("t.lnw", "LNS 1\nLIN 2\nPTS 0 0\nPTS 0 9\nLBP 0 0\nLNN 5\nTPL 1 2\nEOL\n"), "").lines.size() ==
      1);
  CHECK(read_lines(written("t.lnw", "LNW 1.0\nLIN 2\nPTS 0 0\nPTS 0 9\nLNN 5\nEOL\n"), "").lines[0].name == "5");
  CHECK(read_lines(written("t.lnw", "LNS 1\nLIN 2\nPTS 0 0\nPTS 0 9\n"), "").lines.size() == 1);  // no EOL, but whole
  const std::string begin = "LNS 2\nLIN 3\nPTS 0 0\nPTS 0 9\n";
  CHECK(refused("g.lnw", begin + "LNN 1\n") == "g.lnw:5: the line has 2 places, LIN says 3");
  CHECK(refused("h.lnw", begin + "LIN 2\nPTS 5 5\nPTS 5 50\nEOL\n") == "h.lnw:5: the line has 2 places, LIN says 3");
  CHECK(refused("i.lnw", begin + "GARBAGE here\nPTS 0 20\nEOL\n") ==
        "i.lnw:5: is no record; allowed: they begin with three capitals, as PTS, LNN and EOL do");
  CHECK(refused("j.lnw", begin + "TPL 7\nPTS 0 20\nEOL\n") ==
        "j.lnw:5: TPL stands between the line's places; allowed: PTS, LIN says 3 places and 2 are here");
  CHECK(refused("k.lnw", "LNS 1\nPTS 0 0\n") ==
        "k.lnw:2: PTS stands outside a line; allowed: LIN and the number of places");
}

TEST_CASE("a CSV names its columns") {
  const LineSet set = read_lines(
      written("a.csv",
              "name,line,longitude_deg,latitude_deg,depth\nA,1,-9.6,53.2,7\nA,1,-9.6,53.21,7\nB,2,-9.5,53.2,7\n"
              "B,2,-9.5,53.21,7\n"),
      "");
  CHECK(set.geodetic);
  REQUIRE(set.lines.size() == 2);
  CHECK(set.lines[1].name == "B");
  CHECK(set.lines[0].places[1] == std::array<double, 2>{53.21, -9.6});
  CHECK(read_lines(written("a.csv", "\xef\xbb\xbfline,east_m,north_m\n1,0,0\n1,0,9\n"), "").lines.size() == 1);
  CHECK(refused("b.csv", "x,y\n1,2\n").find("b.csv:1: the header is \"x,y\"; allowed: line, and either") == 0);
  CHECK(refused("c.csv", "line,east_m,north_m\n1,0,nan\n") == "c.csv:2: \"nan\" is no number");
  CHECK(refused("d.csv", "line,east_m,north_m,east_m\n1,0,0,5\n") == "d.csv:1: has the column east_m twice");
  CHECK(refused("e.csv", "line,east_m,north_m\n1,465000,00,5895000,00\n") == "e.csv:2: has 5 columns, the header 3");
  CHECK(refused("f.csv", "line,east_m,north_m\n\n1,0\n") == "f.csv:3: has too few columns");
}

TEST_CASE("cells of a CSV may be quoted, and then hold commas, quotes and line ends") {
  const LineSet set = read_lines(
      written(
          "q.csv",
          "\"line\",\"east_m\", \"north_m\" ,\"name\"\r\n\"1\",\"0\",\"0\",\"A \"\"B\"\", C\r\nD\"\r\n1,0, 90 ,,\r\n"
          "2,5,0,\n2,5,90,E\n"),
      "");
  REQUIRE(set.lines.size() == 2);
  CHECK(set.lines[0].places[1] == std::array<double, 2>{0, 90});
  CHECK(set.lines[1].name == "E");
  CHECK(refused("r.csv", "line,name,east_m,north_m\n1,\"a\nb\",0,0\n1,\"x,0,90\n") == "r.csv:4: a quote is not closed");
  CHECK(refused("s.csv", "line,name,east_m,north_m\n1,\"a\"b,0,0\n") ==
        "s.csv:2: text stands behind a quote; allowed: a comma or the line's end");
}

TEST_CASE("GeoJSON, KML and GPX are read, longitude first, points and tracks left out") {
  const std::string geojson = R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"name": "A"}, "geometry": {"type": "LineString", "coordinates": [[-9.6, 53.2], [-9.6, 53.21]]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}},
    {"type": "Feature", "properties": {"name": "B"}, "geometry": {"type": "MultiLineString", "coordinates": [[[-9.5, 53.2], [-9.5, 53.21]]]}}]})";
  const std::string kml =
      R"(<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>A</name><LineString>
      <coordinates>-9.6,53.2,0 -9.6,53.21,0</coordinates></LineString></Placemark><Placemark><name>B</name><LineString>
      <coordinates>-9.5,53.2,0 -9.5,53.21,0</coordinates></LineString></Placemark></Document></kml>)";
  const std::string gpx =
      R"(<?xml version="1.0"?><gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1">
      <rte><name>A</name><rtept lat="53.2" lon="-9.6"/><rtept lat="53.21" lon="-9.6"/></rte>
      <rte><name>B</name><rtept lat="53.2" lon="-9.5"/><rtept lat="53.21" lon="-9.5"/></rte>
      <trk><trkseg><trkpt lat="1" lon="1"/><trkpt lat="2" lon="2"/></trkseg></trk></gpx>)";
  for (const auto& [name, text] : {std::pair("a.geojson", geojson), std::pair("a.kml", kml), std::pair("a.gpx", gpx)}) {
    INFO(name);
    const LineSet set = read_lines(written(name, text), "");
    CHECK(set.geodetic);
    REQUIRE(set.lines.size() == 2);
    CHECK(set.lines[0].name == "A");
    CHECK(set.lines[1].name == "B");
    REQUIRE(set.lines[0].places.size() == 2);
    CHECK(set.lines[0].places[1][0] == Approx(53.21));
    CHECK(set.lines[0].places[1][1] == Approx(-9.6));
  }
}

namespace {

std::string kml_of(const std::string& coordinates, const std::string& name = "A") {
  return "<?xml version=\"1.0\"?><k:kml xmlns:k=\"http://www.opengis.net/kml/2.2\"><k:Placemark><k:name>" + name +
         "</k:name><k:MultiGeometry><k:LineString><k:coordinates>\n " + coordinates +
         "\n</k:coordinates></k:LineString></k:MultiGeometry></k:Placemark></k:kml>";
}

std::string gpx_of(const std::string& points) { return "<gpx version=\"1.1\"><rte>" + points + "</rte></gpx>"; }

}  // namespace

TEST_CASE("invalid positions of KML and GPX are reported with line, place and cause") {
  CHECK(read_lines(written("a.kml", kml_of("-9,53 -9,+53.1,4e1")), "").lines[0].places[1] ==
        std::array<double, 2>{53.1, -9});
  CHECK(refused("b.kml", kml_of("-9,53 -9,abc")) == "b.kml: line 1: place 2: \"abc\" is no number");
  CHECK(refused("c.kml", kml_of("-9,53 -9,")) ==
        "c.kml: line 1: place 2: \"-9,\" is no place; allowed: longitude,latitude or longitude,latitude,height");
  CHECK(refused("d.kml", kml_of("-9,53 nan,53")) == "d.kml: line 1: place 2: \"nan\" is no number");
  CHECK(refused("e.kml", kml_of("-9,53 -9,53.1").substr(0, 150)).find("e.kml: cannot be read: ") == 0);
  CHECK(refused("b.gpx", gpx_of("<rtept lat=\"53\"/><rtept lat=\"53.1\" lon=\"-9\"/>")) ==
        "b.gpx: line 1: place 1: its rtept has no attribute lon");
  CHECK(refused("c.gpx", gpx_of("<rtept lat=\"53\" lon=\"-9\"/><rtept lat=\"5.3.1\" lon=\"-9\"/>")) ==
        "c.gpx: line 1: place 2: \"5.3.1\" is no number");
}

TEST_CASE("what is no plan is refused with its place, its cause and what is allowed") {
  CHECK_THROWS_WITH(read_lines(std::filesystem::temp_directory_path(), ""), Catch::EndsWith(": cannot be read"));
  CHECK(refused("a.txt", "").find("a.txt: has an ending that is not known; allowed: .lnw, .csv") == 0);
  CHECK(refused("a.lnw", "hello\n") == "a.lnw:1: is no LNW file; allowed: it begins with LNS and the number of lines");
  CHECK(refused("b.lnw", "LNS 2\nLIN 2\nPTS 0 0\nPTS 0 9\nLNN 1\nEOL\n") == "b.lnw: has 1 lines, LNS says 2");
  CHECK(refused("c.lnw", "LNS 1\nLIN 3\nPTS 0 0\nPTS 0 9\nLNN 1\nEOL\n") ==
        "c.lnw:6: the line has 2 places, LIN says 3");
  CHECK(refused("d.lnw", "LNS 1\nLIN 2\nPTS 0 0\nPTS 0 0\nLNN 1\nEOL\n") ==
        "d.lnw: line 1: place 2 is less than 1 m from the one before");
  CHECK(refused("e.lnw", "LNS 1\nLIN 2\nPTS 0 inf\nPTS 0 0\nLNN 1\nEOL\n") == "e.lnw:3: \"inf\" is no number");
  CHECK(refused("a.csv", "line,latitude_deg,longitude_deg\n1,-109.6,53.2\n1,-109.6,53.3\n") ==
        "a.csv: line 1: [-109.6, 53.2] is no latitude and longitude; allowed: up to 89.9 and 180 degrees; are they "
        "swapped?");
  CHECK(refused("n.geojson", R"({"type": "LineString", "coordinates": [[-9.6, 53.2], [-9.6, NaN]]})") ==
        "n.geojson: line 1: place 2 is not of finite numbers");
  CHECK(refused("a.geojson", "{").find("a.geojson: cannot be read") == 0);
  for (const std::string crs : {"EPSG:1", "nonsense"}) {
    CHECK_THROWS_WITH(read_lines(written("f.lnw", kLnw), crs),
                      Catch::Contains("--crs " + crs + ": is no reference system"));
  }
}

TEST_CASE("CSV that is printed is read again") {
  const LineSet set = read_lines(written("a.lnw", kLnw), "EPSG:32629");
  const LineSet again = read_lines(written("again.csv", plan_text(set, {}, {}, Format::kCsv)), "");
  REQUIRE(again.lines.size() == set.lines.size());
  CHECK_THAT(again.lines[1].places[2][0], WithinAbs(set.lines[1].places[2][0], 1e-8));
  CHECK(again.lines[0].name == "1_main");
}

TEST_CASE("a name that holds line ends, quotes or commas stays a name in each format") {
  const std::string name = "A\nrepeat: 7\r\n\"x\", y\xe2\x80\xa8z";
  LineSet set{false, {{name, {{0, 0}, {0, 90}}}, {"Linie \xc3\xa9", {{9, 0}, {9, 90}}}}};
  const std::string yaml = plan_text(set, {}, {}, Format::kYaml);
  CHECK(yaml ==
        "ensonify: mission/1\nsteps:\n"
        "  - name: \"A\\nrepeat: 7\\r\\n\\\"x\\\", y\\u2028z\"\n    line: [[0.000, 0.000], [0.000, 90.000]]\n"
        "  - name: \"Linie \xc3\xa9\"\n    line: [[9.000, 0.000], [9.000, 90.000]]\n");
  const LineSet again = read_lines(written("names.csv", plan_text(set, {}, {}, Format::kCsv)), "");
  REQUIRE(again.lines.size() == 2);
  CHECK(again.lines[0].name == name);
  CHECK(again.lines[1].name == set.lines[1].name);

  // Latin-1 in a file that does not say so is no UTF-8: it is replaced, and nothing fails.
  set.lines[0].name = "Linie \xe9";
  CHECK(plan_text(set, {}, {}, Format::kYaml).find("name: \"Linie \xef\xbf\xbd\"\n") != std::string::npos);
  CHECK(plan_text(set, {}, {}, Format::kJson).find("\"Linie \xef\xbf\xbd\"") != std::string::npos);
}

TEST_CASE("names of a KML are read in the encoding that it states") {
  std::string kml = kml_of("-9,53 -9,53.1", "Linie \xe9");
  kml.replace(kml.find("?>"), 2, " encoding=\"ISO-8859-1\"?>");
  CHECK(read_lines(written("latin.kml", kml), "").lines[0].name == "Linie \xc3\xa9");
}
