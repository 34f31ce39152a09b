#pragma once

#include <cstdint>
#include <span>

#include "kernels/acoustics/echo/cell_columns.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// Pieces of bodies that rays have found. Memory of the caller's.
struct BodyScatterers {
  Scatterers smooth;  // each with the phase of its facet (facet_amplitude_m), no random one
  Scatterers rough;   // each with a random response that stays with the piece
  // The newest of the rough ones: rays to it may come in several batches.
  std::uint32_t contributor = 0;
  std::uint64_t piece = 0;

  void clear();
};

/// What the pieces of bodies send back, appended in the order of rays: a scatterer for each piece of which a ray is
/// found. `to_bodies` are the targets of the batch's last rays (trace::RayDistribution::Batch). `hits` are the batch's
/// own: those that are taken become misses, so that nothing else is made of them. Energies are as SpeckleCells has
/// them; the response of a rough piece is a function of (stream, body, piece). Of a smooth piece its one ray decides
/// whether all of it is seen.
void take_bodies(const Insonification& batch, std::span<const trace::BodyTarget> to_bodies, double wavenumber_radpm,
                 const random::Stream& stream, trace::Hits& hits, BodyScatterers& found);

}  // namespace ensonify::echo
