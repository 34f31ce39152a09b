#include "kernels/acoustics/echo/speckle_cells.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace ensonify::echo {
namespace {

constexpr std::size_t kSumsPerTask = 16384;

/// work(first, end) for runs of kCellRun of `count` numbers, side by side.
template <class Work>
void for_runs(std::size_t count, const Work& work) {
  tbb::parallel_for(std::size_t{0}, (count + kCellRun - 1) / kCellRun,
                    [&](std::size_t run) { work(run * kCellRun, std::min(count, (run + 1) * kCellRun)); });
}

}  // namespace

/// The next ping may have some more: no memory for them then.
void SpeckleCells::Accumulator::clear() {
  first_of_.clear();
  const std::size_t size = sums_.size();
  sums_.clear();
  trace::make_room(sums_, size + size / 8);
  shared_.clear();
  found_.clear();
  found_.make_room(size + size / 8);
}

SpeckleCells::SpeckleCells(const CellSize& size, const CellStreams& streams) : size_(size), streams_(streams) {
  if (!(size.cube_m > 0.0)) throw std::invalid_argument("the cells of scatterers must have a size above 0 m");
}

void SpeckleCells::find_parts(const Insonification& batch, std::size_t rays, CellParts& parts) const {
  trace::make_elements(parts.cell, rays);
  trace::make_elements(parts.scattered_upa2m2, rays);
  trace::make_elements(parts.cross_section_m2, rays);
  const CellLattice lattice(size_, batch.pose);
  for_runs(rays, [&](std::size_t first, std::size_t end) { echo::find_parts(batch, lattice, first, end, parts); });
}

void SpeckleCells::add(const Insonification& batch, Accumulator& sum) const {
  find_parts(batch, batch.hits.size(), sum.parts_);
  add(batch, sum.parts_, sum);
}

void SpeckleCells::add(const Insonification& batch, const CellParts& parts, Accumulator& sum) const {
  merge(parts, batch.hits.contributor, sum);
  place_new(batch, sum);
}

/// Adds rays to the sums of their cells and contributors, which are made when they are first found.
void SpeckleCells::merge(const CellParts& parts, std::span<const std::uint32_t> contributors, Accumulator& sum) {
  auto& sums = sum.sums_;
  const auto cell_of = [&](std::uint32_t number) { return sums[number].cell; };
  trace::make_elements(sum.makers_, parts.size());
  sum.others_.clear();
  std::size_t made = 0;
  std::array<std::size_t, kCellRun> slots;
  for (std::size_t begin = 0; begin < parts.size(); begin += kCellRun) {
    const std::size_t end = std::min(parts.size(), begin + kCellRun);
    sum.first_of_.make_room(kCellRun, cell_of);
    for (std::size_t ray = begin; ray < end; ++ray) {
      slots[ray - begin] = sum.first_of_.slot(parts.cell[ray]);
      sum.first_of_.fetch(slots[ray - begin]);
    }
    for (std::size_t ray = begin; ray < end; ++ray) {
      const std::uint32_t number = sum.first_of_.guess(slots[ray - begin]);
      if (number < sums.size()) __builtin_prefetch(&sums[number], 1);
    }
    for (std::size_t ray = begin; ray < end; ++ray) {
      const std::uint64_t cell = parts.cell[ray];
      if (cell == kNoCell) continue;
      const auto next = static_cast<std::uint32_t>(sums.size());
      const std::uint32_t first = sum.first_of_.number(cell, slots[ray - begin], next, cell_of);
      std::uint32_t number = first;
      if (number != next) {
        std::uint32_t last = number;
        while (number != kNone && sums[number].contributor != contributors[ray]) number = sums[last = number].next;
        if (number == kNone) {
          if (last == first) sum.shared_.push_back(first);
          sums[last].next = number = next;
          sum.others_.push_back({next, first});
        }
      }
      if (number == next) {
        sums.push_back({cell, parts.scattered_upa2m2[ray], parts.cross_section_m2[ray], contributors[ray], kNone});
        sum.makers_[made++] = static_cast<std::uint32_t>(ray);
      } else {
        sums[number].scattered_upa2m2 += parts.scattered_upa2m2[ray];
        sums[number].cross_section_m2 += parts.cross_section_m2[ray];
      }
    }
  }
  sum.makers_.resize(made);
}

/// Finds where the scatterers are that rays of this batch make. Those of one cell share the place and the response of
/// its first.
void SpeckleCells::place_new(const Insonification& batch, Accumulator& sum) const {
  const std::size_t before = sum.found_.size();
  sum.found_.resize(sum.sums_.size());
  const CellLattice lattice(size_, batch.pose);
  for_runs(sum.makers_.size(), [&](std::size_t first, std::size_t end) {
    find_geometry(batch, lattice, streams_, std::span(sum.makers_).subspan(first, end - first), sum.found_,
                  before + first);
  });
  for (const auto& [scatterer, first] : sum.others_) sum.found_.set(scatterer, sum.found_[first]);
}

/// A cell's contributors share what it scatters as their energies are.
void SpeckleCells::share(Accumulator& sum) {
  for (const std::uint32_t first : sum.shared_) {
    float scattered_upa2m2 = 0.0F, cross_section_m2 = 0.0F;
    for (std::uint32_t k = first; k != kNone; k = sum.sums_[k].next) {
      scattered_upa2m2 += sum.sums_[k].scattered_upa2m2;
      cross_section_m2 += sum.sums_[k].cross_section_m2;
    }
    for (std::uint32_t k = first; k != kNone; k = sum.sums_[k].next) {
      sum.found_.scattered_upa2m2[k] = scattered_upa2m2;
      sum.found_.cross_section_m2[k] = cross_section_m2;
      if (scattered_upa2m2 > 0.0F) sum.found_.share[k] = sum.sums_[k].scattered_upa2m2 / scattered_upa2m2;
    }
  }
}

const Scatterers& SpeckleCells::gather(Accumulator& sum, const Scatterers& more) {
  Scatterers& found = sum.found_;
  const std::size_t own = sum.sums_.size();
  tbb::parallel_for(std::size_t{0}, (own + kSumsPerTask - 1) / kSumsPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(own, (task + 1) * kSumsPerTask);
    for (std::size_t k = task * kSumsPerTask; k < end; ++k) {
      const Energy& one = sum.sums_[k];
      found.scattered_upa2m2[k] = one.scattered_upa2m2;
      found.cross_section_m2[k] = one.cross_section_m2;
      found.share[k] = 1.0F;
      found.contributor[k] = one.contributor;
    }
  });
  share(sum);
  found.resize(own + more.size());
  for (std::size_t i = 0; i < more.size(); ++i) found.set(own + i, more[i]);
  return found;
}

}  // namespace ensonify::echo
