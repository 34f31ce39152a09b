#include "kernels/acoustics/echo/speckle_cells.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace ensonify::echo {
namespace {

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
  size_ = 0;
  shared_.clear();
  const std::size_t rows = another_.size();
  trace::make_room(another_, rows + rows / 8);
  found_.make_room(rows + rows / 8);
}

/// Rows that are there already keep what they hold, if only of the last ping.
void SpeckleCells::Accumulator::make_rows(std::size_t count) {
  if (another_.size() < count) another_.resize(count);
  if (found_.size() < count) found_.resize(count);
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
  const std::uint32_t before = sum.size_;
  merge(parts, batch.hits.contributor, sum);
  place_new(batch, before, sum);
}

/// Adds rays to the sums of their cells and contributors, which are made when they are first found. Whether a cell is
/// new is not predicted, so no branch asks for it: each ray writes a scatterer behind the last one, and the next ray
/// writes over it unless the cell was new.
void SpeckleCells::merge(const CellParts& parts, std::span<const std::uint32_t> contributors, Accumulator& sum) {
  const std::uint32_t before = sum.size_;
  std::uint32_t next = before;
  trace::make_elements(sum.makers_, parts.size() + 1);
  sum.others_.clear();
  std::array<std::uint32_t, kCellRun> slot, row;
  for (std::size_t begin = 0; begin < parts.size(); begin += kCellRun) {
    const std::size_t count = std::min(kCellRun, parts.size() - begin);
    sum.first_of_.make_room(count);
    sum.make_rows(next + count + 1);
    const std::uint64_t* const cell = parts.cell.data() + begin;
    float* const scattered = sum.found_.scattered_upa2m2.data();
    float* const cross_section = sum.found_.cross_section_m2.data();
    std::uint32_t* const contributor = sum.found_.contributor.data();
    std::uint32_t* const another = sum.another_.data();
    std::uint32_t* const maker = sum.makers_.data();
    for (std::size_t i = 0; i < count; ++i) {
      slot[i] = sum.first_of_.slot(cell[i]);
      sum.first_of_.fetch(slot[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (cell[i] != kNoCell) row[i] = sum.first_of_.row(cell[i], slot[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (cell[i] == kNoCell) continue;
      const std::size_t ray = begin + i;
      scattered[next] = cross_section[next] = 0.0F;
      contributor[next] = contributors[ray];
      another[next] = kNone;
      maker[next - before] = static_cast<std::uint32_t>(ray);
      std::uint32_t& first = sum.first_of_.number(cell[i], row[i]);
      first = std::min(first, next);
      std::uint32_t number = first;
      next += number == next ? 1 : 0;
      if (contributor[number] != contributors[ray]) {
        std::uint32_t last = number;
        while (number != kNone && contributor[number] != contributors[ray]) number = another[last = number];
        if (number == kNone) {
          if (last == first) sum.shared_.push_back(first);
          sum.others_.push_back({next, first});
          another[last] = number = next++;
        }
      }
      scattered[number] += parts.scattered_upa2m2[ray];
      cross_section[number] += parts.cross_section_m2[ray];
    }
  }
  sum.makers_.resize(next - before);
  sum.size_ = next;
}

/// Finds where the scatterers are that rays of this batch make. Those of one cell share the place and the response of
/// its first.
void SpeckleCells::place_new(const Insonification& batch, std::size_t before, Accumulator& sum) const {
  const CellLattice lattice(size_, batch.pose);
  for_runs(sum.makers_.size(), [&](std::size_t first, std::size_t end) {
    find_geometry(batch, lattice, streams_, std::span(sum.makers_).subspan(first, end - first), sum.found_,
                  before + first);
  });
  for (const auto& [scatterer, first] : sum.others_) {
    Scatterer other = sum.found_[first];
    other.scattered_upa2m2 = sum.found_.scattered_upa2m2[scatterer];
    other.cross_section_m2 = sum.found_.cross_section_m2[scatterer];
    other.contributor = sum.found_.contributor[scatterer];
    sum.found_.set(scatterer, other);
  }
}

/// A cell's contributors share what it scatters as their energies are; once.
void SpeckleCells::share(Accumulator& sum) {
  Scatterers& found = sum.found_;
  for (const std::uint32_t first : sum.shared_) {
    float scattered_upa2m2 = 0.0F, cross_section_m2 = 0.0F;
    for (std::uint32_t k = first; k != kNone; k = sum.another_[k]) {
      scattered_upa2m2 += found.scattered_upa2m2[k];
      cross_section_m2 += found.cross_section_m2[k];
    }
    for (std::uint32_t k = first; k != kNone; k = sum.another_[k]) {
      if (scattered_upa2m2 > 0.0F) found.share[k] = found.scattered_upa2m2[k] / scattered_upa2m2;
      found.scattered_upa2m2[k] = scattered_upa2m2;
      found.cross_section_m2[k] = cross_section_m2;
    }
  }
  sum.shared_.clear();
}

const Scatterers& SpeckleCells::gather(Accumulator& sum, const Scatterers& more) {
  share(sum);
  Scatterers& found = sum.found_;
  found.resize(sum.size_ + more.size());
  for (std::size_t i = 0; i < more.size(); ++i) found.set(sum.size_ + i, more[i]);
  return found;
}

}  // namespace ensonify::echo
