#pragma once

#include <span>
#include <vector>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// Numbers on a window: coefficients of a quintic B-spline surface, or values.
struct Grid {
  Window window;
  std::vector<float> value;
};

/// The surface that coefficients c on the nodes of level k stand for is
///   z(x, y) = sum of c(i, j) b(x / h - i) b(y / h - j),  b the quintic B-spline, h the node spacing of level k,
/// twice as smooth as a cubic one: four continuous derivatives, so neither slopes nor curvatures show the lattice.
/// b(x) is a sum of b(2 x - k) with weights {1, 6, 15, 20, 15, 6, 1} / 32, k = -3..3 [Chui1992, ch. 4], so that a
/// surface of level k + 1 is also one of level k, exactly.

/// The window of level k whose coefficients give the surface at all nodes of `posts`, which has the same level.
Window knots_of(const Window& posts);

/// The window of the next coarser level whose coefficients give those of `fine`.
Window coarser(const Window& fine);

/// The same surface one level finer: the coefficients on `fine.window`, from those on coarser(fine.window).
void refine(const Grid& coarse, Grid& fine);

/// The surface at the nodes of `posts`, from coefficients on knots_of(posts).
void evaluate(const Grid& knots, const Window& posts, std::span<float> out);

/// Adds white noise to numbers on the nodes of a window: independent from node to node, mean 0, standard deviation
/// `sd`, triangular between -sqrt(6) sd and sqrt(6) sd. A node's noise is a function of the stream, the level and the
/// node. If `amplitude` is not empty it multiplies the noise, node by node.
void add_white(const random::Stream& stream, float sd, std::span<const float> amplitude, const Window& window,
               std::span<float> numbers);

}  // namespace ensonify::relief
