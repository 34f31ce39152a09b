#include "components/terrain/mesh_message.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace ensonify {
namespace {

constexpr std::size_t kSplitNumbers = 7;

void check_shape(const std::vector<std::size_t>& shape, std::size_t rows, std::size_t columns, const char* name) {
  const bool empty = rows == 0 && (shape.empty() || shape[0] == 0);
  if (!empty && (shape.size() != 2 || shape[0] != rows || shape[1] != columns))
    throw std::invalid_argument(std::string("mesh: the shape of ") + name + " does not fit");
}

template <class Number>
std::vector<Number> vector_of(const msg::Array<Number>& numbers) {
  return {numbers.flat().begin(), numbers.flat().end()};
}

}  // namespace

msg::Mesh mesh_message(const progressive::Hierarchy& hierarchy) {
  const progressive::TriangleMesh& mesh = hierarchy.mesh;
  const std::size_t splits = hierarchy.splits.size();
  msg::Mesh message;
  message.origin_enu_m = {mesh.origin_enu_m.x(), mesh.origin_enu_m.y(), mesh.origin_enu_m.z()};
  message.vertex_m = msg::Array<float>({mesh.vertex_m.size(), 3});
  for (std::size_t v = 0; v < mesh.vertex_m.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      message.vertex_m(v, axis) = mesh.vertex_m[v][static_cast<Eigen::Index>(axis)];
  }
  message.triangle = msg::Array<std::uint32_t>({mesh.triangle.size(), 3});
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) message.triangle(t, corner) = mesh.triangle[t][corner];
  }
  message.split = msg::Array<std::int32_t>({splits, kSplitNumbers});
  message.split_deviation_m = msg::Array<float>({splits});
  message.split_box_m = msg::Array<float>({splits, 6});
  for (std::size_t s = 0; s < splits; ++s) {
    const progressive::Split& split = hierarchy.splits[s];
    const std::array numbers = {static_cast<std::int32_t>(split.removed),
                                static_cast<std::int32_t>(split.kept),
                                split.parent,
                                split.child[0],
                                split.child[1],
                                static_cast<std::int32_t>(split.first_born),
                                static_cast<std::int32_t>(split.born)};
    std::copy(numbers.begin(), numbers.end(), message.split.row(s).begin());
    message.split_deviation_m[s] = split.deviation_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      message.split_box_m(s, axis) = split.box_m.min()[static_cast<Eigen::Index>(axis)];
      message.split_box_m(s, 3 + axis) = split.box_m.max()[static_cast<Eigen::Index>(axis)];
    }
  }
  message.born = msg::Array<std::uint32_t>::of(hierarchy.born);
  message.coarsest = msg::Array<std::uint32_t>::of(hierarchy.coarsest);
  return message;
}

progressive::Hierarchy hierarchy_of(const msg::Mesh& message) {
  const std::size_t splits = message.split.rows();
  check_shape(message.vertex_m.shape(), message.vertex_m.rows(), 3, "vertex_m");
  check_shape(message.triangle.shape(), message.triangle.rows(), 3, "triangle");
  check_shape(message.split.shape(), splits, kSplitNumbers, "split");
  check_shape(message.split_box_m.shape(), splits, 6, "split_box_m");
  if (message.split_deviation_m.size() != splits)
    throw std::invalid_argument("mesh: the shape of split_deviation_m does not fit");
  progressive::Hierarchy hierarchy;
  progressive::TriangleMesh& mesh = hierarchy.mesh;
  mesh.origin_enu_m = {message.origin_enu_m[0], message.origin_enu_m[1], message.origin_enu_m[2]};
  for (std::size_t v = 0; v < message.vertex_m.rows(); ++v)
    mesh.vertex_m.emplace_back(message.vertex_m(v, 0), message.vertex_m(v, 1), message.vertex_m(v, 2));
  for (std::size_t t = 0; t < message.triangle.rows(); ++t)
    mesh.triangle.push_back({message.triangle(t, 0), message.triangle(t, 1), message.triangle(t, 2)});
  hierarchy.splits.resize(splits);
  hierarchy.split_of.assign(mesh.vertex_m.size(), progressive::kNone);
  for (std::size_t s = 0; s < splits; ++s) {
    progressive::Split& split = hierarchy.splits[s];
    const auto numbers = message.split.row(s);
    split.removed = static_cast<std::uint32_t>(numbers[0]);
    split.kept = static_cast<std::uint32_t>(numbers[1]);
    split.parent = numbers[2];
    split.child = {numbers[3], numbers[4]};
    split.first_born = static_cast<std::uint32_t>(numbers[5]);
    split.born = static_cast<std::uint32_t>(numbers[6]);
    split.deviation_m = message.split_deviation_m[s];
    const auto box = message.split_box_m.row(s);
    split.box_m = Eigen::AlignedBox3f(Eigen::Vector3f(box[0], box[1], box[2]), Eigen::Vector3f(box[3], box[4], box[5]));
    if (split.removed < hierarchy.split_of.size()) hierarchy.split_of[split.removed] = static_cast<std::int32_t>(s);
  }
  hierarchy.born = vector_of(message.born);
  hierarchy.coarsest = vector_of(message.coarsest);
  return hierarchy;
}

}  // namespace ensonify
