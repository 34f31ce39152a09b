#include "kernels/seabed/relief/seabed.h"

#include <catch2/catch.hpp>

using namespace ensonify::relief;

namespace {

struct Node {
  float height_m;
  int sediment;
};

Node at(const Seabed& seabed) {
  Node node{};
  std::uint8_t sediment = 0;
  seabed.fill({0, 0, 0, 1, 1}, std::span(&node.height_m, 1), std::span(&sediment, 1));
  node.sediment = sediment;
  return node;
}

}  // namespace

TEST_CASE("layers add, cover and cut in their order") {
  const Layer add{.height_m = constant(2.0F)};
  const Layer fill{.height_m = constant(-15.0F), .join = Layer::Join::kCover, .sediment = 3};
  const Layer cut{.height_m = constant(-16.0F), .join = Layer::Join::kCut, .sediment = 5};
  CHECK(at({constant(-20.0F), constant(7.0F), {}}).height_m == -20.0F);
  CHECK(at({constant(-20.0F), constant(7.0F), {}}).sediment == 7);
  CHECK(at({constant(-20.0F), nullptr, {add}}).height_m == -18.0F);
  CHECK(at({constant(-20.0F), nullptr, {add, fill}}).height_m == -15.0F);
  CHECK(at({constant(-20.0F), nullptr, {fill, add}}).height_m == -13.0F);
  CHECK(at({constant(-20.0F), nullptr, {fill, add, cut}}).height_m == -16.0F);
  CHECK(at({constant(-20.0F), nullptr, {fill, add, cut}}).sediment == 5);
  CHECK(at({constant(-10.0F), constant(1.0F), {fill}}).height_m == -10.0F);  // already higher
  CHECK(at({constant(-10.0F), constant(1.0F), {fill}}).sediment == 1);
}

TEST_CASE("a mask blends the height, and the class changes where it passes a half") {
  const auto layer = [](float mask) {
    return Layer{.height_m = constant(2.0F), .mask = constant(mask), .sediment = 9};
  };
  CHECK(at({constant(-20.0F), nullptr, {layer(0.25F)}}).height_m == -19.5F);
  CHECK(at({constant(-20.0F), nullptr, {layer(0.25F)}}).sediment == 0);
  CHECK(at({constant(-20.0F), nullptr, {layer(0.75F)}}).sediment == 9);
  const Layer low{.height_m = constant(0.01F), .sediment = 9, .shows_above_m = 0.05};
  CHECK(at({constant(-20.0F), nullptr, {low}}).sediment == 0);
}

TEST_CASE("a cover's height can count from the bottom as it was before") {
  const Layer rock{.height_m = constant(2.0F), .mask = constant(0.5F)};  // 1 m of it
  const auto sand = [](float thick) {
    return Layer{.height_m = constant(thick), .join = Layer::Join::kCover, .above = 0, .sediment = 1};
  };
  CHECK(at({constant(-20.0F), nullptr, {rock, sand(1.5F)}}).height_m == -18.5F);
  CHECK(at({constant(-20.0F), nullptr, {rock, sand(1.5F)}}).sediment == 1);
  CHECK(at({constant(-20.0F), nullptr, {rock, sand(0.5F)}}).height_m == -19.0F);
  CHECK(at({constant(-20.0F), nullptr, {rock, sand(0.5F)}}).sediment == 0);
  CHECK_THROWS_WITH(Seabed(constant(0.0F), nullptr, {{.height_m = constant(0.0F), .above = 1}}),
                    "seabed: a layer's height counts from a bottom that is not there yet");
}

TEST_CASE("a seabed without base or a layer without height is refused") {
  CHECK_THROWS_WITH(Seabed(nullptr, nullptr, {}), "seabed: there is no base to lay layers on");
  CHECK_THROWS_WITH(Seabed(constant(0.0F), nullptr, {Layer{}}), "seabed: a layer has no height");
}
