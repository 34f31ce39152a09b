#include "kernels/acoustics/echo/cell_table.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

using namespace ensonify::echo;

namespace {

std::uint64_t cell_of(std::uint64_t east, std::uint64_t north, std::uint64_t up) {
  return east | north << kCellBits | up << (2 * kCellBits);
}

/// Looks cells up one after the other; the cells by the numbers that they got.
std::vector<std::uint64_t> numbered(CellTable& table, const std::vector<std::uint64_t>& cells) {
  std::vector<std::uint64_t> by_number;
  for (const std::uint64_t one : cells) {
    table.make_room(1);
    std::uint32_t& number = table.number(one, table.row(one, table.slot(one)));
    if (number == CellTable::kNone) {
      number = static_cast<std::uint32_t>(by_number.size());
      by_number.push_back(one);
    }
    REQUIRE(by_number.at(number) == one);
  }
  return by_number;
}

}  // namespace

TEST_CASE("each cell has one number, however many there are, dense or far apart") {
  for (const std::uint64_t step : {1U, 4U, 1000U}) {
    std::vector<std::uint64_t> cells;
    for (std::uint64_t i = 0; i < 150; ++i) {
      for (std::uint64_t j = 0; j < 150; ++j) cells.push_back(cell_of(i * step, j * step, i * j % 3));
    }
    std::vector<std::uint64_t> twice = cells;
    twice.insert(twice.end(), cells.rbegin(), cells.rend());
    CellTable table;
    CHECK(numbered(table, twice) == cells);
  }
}

TEST_CASE("cells of a patch of 4 x 4 share a row, and no others do") {
  CellTable table;
  table.make_room(1000);
  std::map<std::uint32_t, std::set<std::uint64_t>> patches;  // by row
  for (std::uint64_t east = 0; east < 10; ++east) {
    for (std::uint64_t north = 0; north < 10; ++north) {
      for (std::uint64_t up = 0; up < 2; ++up) {
        const std::uint64_t cell = cell_of(east, north, up);
        const std::uint32_t row = table.row(cell, table.slot(cell));
        REQUIRE(table.row(cell, table.slot(cell)) == row);
        patches[row].insert(cell_of(east / 4, north / 4, up));
        std::uint32_t& number = table.number(cell, row);
        REQUIRE(number == CellTable::kNone);  // no other cell of the patch has this place
        number = 0;
      }
    }
  }
  CHECK(patches.size() == 3 * 3 * 2);
  for (const auto& [row, of_row] : patches) CHECK(of_row.size() == 1);
}

TEST_CASE("a table that was cleared has no cell, also after as many rounds as it can count") {
  CellTable table;
  for (std::uint64_t round = 0; round < 600; ++round) {
    // The same cells every other round: a mark that was left over would be found.
    std::vector<std::uint64_t> cells;
    for (std::uint64_t i = 0; i < 20; ++i) cells.push_back(cell_of(7 * i + round % 2, round % 2, 0));
    CHECK(numbered(table, cells) == cells);
    table.clear();
  }
  // Rounds without a cell between: 255 later the numbers of the first would be those of the last.
  const std::vector<std::uint64_t> first{cell_of(1, 2, 3), cell_of(4, 5, 6)}, last{cell_of(4, 5, 6), cell_of(1, 2, 3)};
  CHECK(numbered(table, first) == first);
  for (int round = 0; round < 255; ++round) table.clear();
  CHECK(numbered(table, last) == last);
}
