#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kernels/acoustics/echo/cell_lattice.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/trace/ray.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/base/random/stream.h"

/// What SpeckleCells computes of many rays or cells at once, in columns.
namespace ensonify::echo {

/// Rays of a transmission, all or a batch of them, and what they hit. Hits and spans have one entry per ray.
struct Insonification {
  const frames::HeadPose& pose;  // of the head
  const trace::Rays& rays;
  const trace::Hits& hits;
  /// Mean-square pressure at 1 m in the ray's direction, uPa^2 m^2: source level with the transmit pattern.
  std::span<const float> source_upa2m2;
  /// Scattering cross section per unit area and solid angle at the hit, a ratio (seabed kernel).
  std::span<const float> backscatter;
};

constexpr std::size_t kCellRun = 256;  // rays or cells whose numbers stay in the first cache

/// What rays bring to their cells, by ray. Memory of the caller's.
struct CellParts {
  std::vector<std::uint64_t> cell;  // kNoCell where the ray hit nothing
  std::vector<float> scattered_upa2m2, cross_section_m2;
  std::size_t size() const { return cell.size(); }
};

/// Parts of rays first..end - 1 of a batch, into rows of the same numbers.
void find_parts(const Insonification& batch, CellLattice lattice, std::size_t first, std::size_t end, CellParts& parts);

/// Random numbers of cells, by their number: where the scatterer is in its cell, and its response.
struct CellStreams {
  CellStreams(std::uint64_t seed, std::string_view name) : places(seed, name) {}
  /// Responses of a seed of their own.
  CellStreams(std::uint64_t seed, std::string_view name, std::uint64_t speckle_seed) : CellStreams(seed, name) {
    if (speckle_seed != seed) speckle.emplace(speckle_seed, name);
  }
  explicit CellStreams(const random::Stream& both) : places(both) {}

  random::Stream places;
  std::optional<random::Stream> speckle;  // of responses; nothing: as of places

  const random::Stream& responses() const { return speckle ? *speckle : places; }
};

/// Where the scatterers of cells are and all that is known of them but energies and contributors, into rows first.. of
/// `found`: one for each of these rays, kCellRun at most, that hit something. The position depends on (places, cell)
/// and on the facet, the response on (responses, cell). Each has the whole of its cell's pressure.
void find_geometry(const Insonification& batch, CellLattice lattice, const CellStreams& streams,
                   std::span<const std::uint32_t> rays, Scatterers& found, std::size_t first);

}  // namespace ensonify::echo
