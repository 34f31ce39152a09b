#pragma once

#include <nodes_found.h>  // generated: tests/physics/CMakeLists.txt

#include <tuple>
#include <type_traits>

#include "components/sonar/head_node.h"

namespace ensonify::physics {

// clang-format off
template <class Node> struct IsHead : std::false_type {};
template <class Head> struct IsHead<HeadNode<Head>> : std::true_type {};
template <class Found, class... Nodes> struct Heads { using Type = Found; };
// clang-format on
template <class... Found, class Node, class... Rest>
struct Heads<std::tuple<Found...>, Node, Rest...>
    : std::conditional_t<IsHead<Node>::value, Heads<std::tuple<Found..., Node>, Rest...>,
                         Heads<std::tuple<Found...>, Rest...>> {};
template <class... Nodes>
typename Heads<std::tuple<>, Nodes...>::Type heads_among(std::tuple<Nodes...>*);
/// Nodes of all components that are heads.
using HeadsFound = decltype(heads_among(static_cast<NodesFound*>(nullptr)));

}  // namespace ensonify::physics
