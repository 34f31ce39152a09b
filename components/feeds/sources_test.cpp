#include "components/feeds/sources.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace ensonify;

namespace {

std::filesystem::path log_of(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("ensonify_sources_test_" + name);
  std::ofstream(path) << text;
  return path;
}

}  // namespace

TEST_CASE("pieces of several logs come in the order of their arrival, as sim time goes on") {
  const auto first =
      log_of("a", "2014-08-01T00:00:00Z $GPZDA,120000.00,01,08,2014,,*6B\n$GPZDA,120002.00,01,08,2014,,*69\n");
  const auto second = log_of("b", "$GPZDA,235959.50,01,08,2014,,*6C\n$GPZDA,000000.50,02,08,2014,,*6E\n");
  std::vector<ByteSource> logs(2);
  logs[0].way = ByteSource::File{first};
  logs[1].way = ByteSource::File{second};
  Sources sources(logs);
  std::vector<std::pair<std::size_t, double>> taken;
  for (int i = 0; i <= 300; ++i) {
    for (const FedPiece& piece : sources.take(from_seconds(0.01 * i))) {
      CHECK(piece.bytes.front() == '$');
      taken.emplace_back(piece.source, seconds(piece.arrival));
    }
  }
  CHECK(taken == std::vector<std::pair<std::size_t, double>>{{0, 0.0}, {1, 0.0}, {1, 1.0}, {0, 2.0}});
  std::filesystem::remove(first);
  std::filesystem::remove(second);
}

TEST_CASE("a source that cannot be opened is named") {
  std::vector<ByteSource> one(1);
  one[0].name = "gyro";
  one[0].way = ByteSource::Serial{"/dev/no_such_line", 4800};
  CHECK_THROWS_WITH(Sources(one), Catch::Contains("sources.gyro: cannot open the serial line /dev/no_such_line"));
}
