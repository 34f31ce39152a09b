#include "components/terrain/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "components/config/config_error.h"
#include "components/terrain/mesh_import.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify::source {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kMostVertices = 100'000'000;

[[noreturn]] void refuse(const std::string& path, int line, const std::string& why) {
  throw ConfigError({ConfigProblem{{path, line, 1}, "", why}});
}

/// Corners into triangles around the first one.
void add_face(const std::vector<std::uint32_t>& corners, MeshFile& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::uint32_t a = corners[0], b = corners[i - 1], c = corners[i];
    if (a != b && b != c && c != a) mesh.triangle.push_back({a, b, c});
  }
}

/// One of its corners opens wider than rounding does.
bool has_area(const MeshFile& mesh, const std::array<std::uint32_t, 3>& triangle) {
  constexpr double kRounding = 1e-12;  // sine
  for (std::size_t k = 0; k < 3; ++k) {
    const frames::Vec3& corner = mesh.vertex[triangle[k]];
    const frames::Vec3 one = (mesh.vertex[triangle[(k + 1) % 3]] - corner).stableNormalized();
    const frames::Vec3 other = (mesh.vertex[triangle[(k + 2) % 3]] - corner).stableNormalized();
    if (one.cross(other).norm() > kRounding) return true;
  }
  return false;
}

/// "3", "3/1", "3//2" or "-1", which counts back from the last vertex, as a number from 0.
std::uint32_t obj_corner(const std::string& word, std::size_t vertices, const std::string& path, int line) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (number < 0) number += static_cast<std::int64_t>(vertices) + 1;
  if (error != std::errc() || (end != word.data() + word.size() && *end != '/') || number < 1 ||
      number > static_cast<std::int64_t>(vertices))
    refuse(path, line, "\"" + word + "\" is no vertex; allowed: a number of one of the lines v above it");
  return static_cast<std::uint32_t>(number - 1);
}

MeshFile read_obj(std::istream& file, const std::string& path) {
  MeshFile mesh;
  std::string line;
  for (int n = 1; std::getline(file, line); ++n) {
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    if (kind == "v") {
      frames::Vec3 place;
      if (!(words >> place.x() >> place.y() >> place.z()) || !place.allFinite())
        refuse(path, n, "is no vertex; allowed: v and three numbers");
      mesh.vertex.push_back(place);
    } else if (kind == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) corners.push_back(obj_corner(word, mesh.vertex.size(), path, n));
      if (corners.size() < 3) refuse(path, n, "is no face; allowed: f and three vertices or more");
      add_face(corners, mesh);
    }
  }
  return mesh;
}

/// A property of a PLY element: one number, or a list of them behind its length.
struct Property {
  std::string name, type, length_type;
  bool list() const { return !length_type.empty(); }
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

template <class Number>
double binary(std::istream& file) {
  char bytes[sizeof(Number)] = {};
  file.read(bytes, sizeof bytes);
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

/// Reads a PLY file's numbers, one after another.
class Ply {
 public:
  Ply(std::istream& file, const std::string& path) : file_(file), path_(path) { read_header(); }

  MeshFile read() {
    MeshFile mesh;
    for (const Element& element : elements_) {
      for (std::size_t i = 0; i < element.count; ++i) {
        frames::Vec3 place = frames::Vec3::Zero();
        for (const Property& property : element.properties) {
          if (property.list()) {
            read_list(element, property, mesh);
          } else {
            const double value = number(property.type);
            if (property.name == "x") place.x() = value;
            if (property.name == "y") place.y() = value;
            if (property.name == "z") place.z() = value;
          }
        }
        if (!file_) refuse(path_, 1, fmt::format("ends within its {} elements {}", element.count, element.name));
        if (element.name == "vertex") mesh.vertex.push_back(place);
      }
    }
    return mesh;
  }

 private:
  void read_header() {
    std::string line, word;
    for (int n = 1; std::getline(file_, line); ++n) {
      std::istringstream words(line);
      words >> word;
      if (word == "end_header") return;
      if (word == "format") {
        words >> word;
        ascii_ = word == "ascii";
        if (!ascii_ && word != "binary_little_endian")
          refuse(path_, n, "format " + word + " is not read; allowed: ascii, binary_little_endian");
      } else if (word == "element") {
        elements_.emplace_back();
        words >> elements_.back().name >> elements_.back().count;
        if (!words || elements_.back().count > kMostVertices) refuse(path_, n, "is no element of up to 1e8");
      } else if (word == "property" && !elements_.empty()) {
        Property property;
        words >> property.type;
        if (property.type == "list") words >> property.length_type >> property.type;
        words >> property.name;
        elements_.back().properties.push_back(property);
      }
    }
    refuse(path_, 1, "has no end_header");
  }

  void read_list(const Element& element, const Property& property, MeshFile& mesh) {
    const double count = number(property.length_type);
    if (!(count >= 0.0 && count <= 1e6)) refuse(path_, 1, "has a list that is longer than 1e6");
    std::vector<std::uint32_t> corners;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const double corner = number(property.type);
      if (element.name != "face") continue;
      if (!(corner >= 0.0 && corner < static_cast<double>(mesh.vertex.size())))
        refuse(path_, 1, fmt::format("has a face with a corner {}, of {} vertices", corner, mesh.vertex.size()));
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
    if (property.name == "vertex_indices" || property.name == "vertex_index") add_face(corners, mesh);
  }

  double number(const std::string& type) {
    if (ascii_) {
      double value = std::numeric_limits<double>::quiet_NaN();
      file_ >> value;
      return value;
    }
    if (type == "char" || type == "int8") return binary<std::int8_t>(file_);
    if (type == "uchar" || type == "uint8") return binary<std::uint8_t>(file_);
    if (type == "short" || type == "int16") return binary<std::int16_t>(file_);
    if (type == "ushort" || type == "uint16") return binary<std::uint16_t>(file_);
    if (type == "int" || type == "int32") return binary<std::int32_t>(file_);
    if (type == "uint" || type == "uint32") return binary<std::uint32_t>(file_);
    if (type == "float" || type == "float32") return binary<float>(file_);
    if (type == "double" || type == "float64") return binary<double>(file_);
    refuse(path_, 1, "has numbers of type \"" + type + "\"; allowed: char to uint, float, double");
  }

  std::istream& file_;
  const std::string& path_;
  bool ascii_ = true;
  std::vector<Element> elements_;
};

}  // namespace

bool is_mesh_file(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  return ending == ".obj" || ending == ".ply";
}

MeshFile read_mesh_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, 1, "cannot be read");
  std::string magic(3, '\0');
  file.read(magic.data(), 3);
  file.clear();
  file.seekg(0);
  MeshFile mesh = is_imported_mesh(path) ? import_mesh(path)
                  : magic == "ply"       ? Ply(file, path).read()
                                         : read_obj(file, path);
  for (const frames::Vec3& place : mesh.vertex) {
    if (!place.allFinite()) refuse(path, 1, "has a vertex that is not finite");
  }
  if (mesh.triangle.empty()) refuse(path, 1, "holds no triangle; allowed are meshes in OBJ, PLY, STL, OFF or glTF");
  if (std::none_of(mesh.triangle.begin(), mesh.triangle.end(), [&](const auto& t) { return has_area(mesh, t); }))
    refuse(path, 1, "has no area: the corners of each of its triangles lie on one line");
  return mesh;
}

}  // namespace ensonify::source
