// KML and GPX, element by element: GDAL's own drivers make 0 of what is no number, and leave out places without one.
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <cstring>
#include <functional>
#include <memory>
#include <sstream>

#include "components/errors/exit_error.h"
#include "tools/plan/line_files.h"

namespace ensonify::plan {
namespace {

bool is_element(const CPLXMLNode* node, const char* name) {
  return node->eType == CXT_Element && std::strcmp(node->pszValue, name) == 0;
}

struct Xml {
  std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)> root;  // elements without their name spaces
  std::string encoding;

  /// The text of an element's child, in UTF-8; "" without one.
  std::string text(const CPLXMLNode* node, const char* child) const {
    const std::unique_ptr<char, decltype(&VSIFree)> text(
        CPLRecode(CPLGetXMLValue(node, child, ""), encoding.c_str(), CPL_ENC_UTF8), &VSIFree);
    return text.get();
  }
};

Xml read_xml(const std::string& path) {
  CPLErrorReset();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  Xml xml{{CPLParseXMLFile(path.c_str()), &CPLDestroyXMLNode}, CPL_ENC_UTF8};
  const std::string why = CPLGetLastErrorMsg();
  CPLPopErrorHandler();
  if (!xml.root) throw UserError(path + ": cannot be read" + (why.empty() ? "" : ": " + why));
  if (is_element(xml.root.get(), "?xml")) xml.encoding = CPLGetXMLValue(xml.root.get(), "encoding", CPL_ENC_UTF8);
  CPLStripXMLNamespace(xml.root.get(), nullptr, TRUE);
  return xml;
}

/// Every element of a node and its siblings, with all below, in the order of the file.
void visit(const CPLXMLNode* first, const std::function<void(const CPLXMLNode*)>& see) {
  for (const CPLXMLNode* node = first; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    see(node);
    visit(node->psChild, see);
  }
}

/// Of a line's k-th place: "longitude,latitude" or "longitude,latitude,height".
std::array<double, 2> kml_place(const std::string& text, const std::string& place) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string part; std::getline(stream, part, ',');) numbers.push_back(number_of(part, place));
  if (numbers.size() < 2 || numbers.size() > 3) {
    throw UserError(
        fmt::format("{}: \"{}\" is no place; allowed: longitude,latitude or longitude,latitude,height", place, text));
  }
  return {numbers[1], numbers[0]};
}

std::string place_name(const std::string& path, const LineSet& set) {
  return fmt::format("{}: line {}: place {}", path, set.lines.size(), set.lines.back().places.size() + 1);
}

}  // namespace

LineSet read_kml(const std::string& path) {
  const Xml xml = read_xml(path);
  LineSet set;
  set.geodetic = true;
  visit(xml.root.get(), [&](const CPLXMLNode* placemark) {
    if (!is_element(placemark, "Placemark")) return;
    visit(placemark->psChild, [&](const CPLXMLNode* line) {
      if (!is_element(line, "LineString")) return;
      set.lines.push_back({xml.text(placemark, "name"), {}});
      std::istringstream coordinates(CPLGetXMLValue(line, "coordinates", ""));
      for (std::string text; coordinates >> text;) {
        set.lines.back().places.push_back(kml_place(text, place_name(path, set)));
      }
    });
  });
  return set;
}

LineSet read_gpx(const std::string& path) {
  const Xml xml = read_xml(path);
  LineSet set;
  set.geodetic = true;
  visit(xml.root.get(), [&](const CPLXMLNode* route) {
    if (!is_element(route, "rte")) return;
    set.lines.push_back({xml.text(route, "name"), {}});
    for (const CPLXMLNode* point = route->psChild; point != nullptr; point = point->psNext) {
      if (!is_element(point, "rtept")) continue;
      const std::string place = place_name(path, set);
      const auto attribute = [&](const char* name) {
        const char* text = CPLGetXMLValue(point, name, nullptr);
        if (text == nullptr) throw UserError(fmt::format("{}: its rtept has no attribute {}", place, name));
        return number_of(text, place);
      };
      set.lines.back().places.push_back({attribute("lat"), attribute("lon")});
    }
  });
  return set;
}

}  // namespace ensonify::plan
