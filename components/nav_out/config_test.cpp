#include "components/nav_out/config.h"

#include <catch2/catch.hpp>

#include "components/config/config_reader.h"
#include "components/config/read_parameters.h"

using namespace ensonify;
using Catch::Matchers::Contains;

namespace {

NavOutParameters read(const std::string& yaml) {
  ConfigReader from = ConfigReader::from_text(yaml, "out.yaml");
  NavOutParameters parameters;
  read_parameters(from, parameters);
  from.finish();
  return parameters;
}

}  // namespace

TEST_CASE("a serial line's rate is a limit, and a mistake says what it carries") {
  CHECK_THROWS_WITH(
      read("outputs: { mru: { serial: /dev/ttyUSB0, baud: 9600, format: tss1, rate_hz: 100 } }"),
      Contains("outputs.mru.rate_hz: TSS1 at 100 Hz needs 2700 bytes/s, and a line of 9600 baud carries 960; "
               "allowed: 35 Hz at most, or 38400 baud"));
  CHECK_NOTHROW(read("outputs: { mru: { serial: /dev/ttyUSB0, baud: 9600, format: tss1, rate_hz: 35 } }"));
  CHECK_NOTHROW(read("outputs: { mru: { udp: 10110, format: tss1, rate_hz: 100 } }"));
  CHECK_THROWS_WITH(
      read("outputs: { nav: { serial: /dev/ttyUSB0, baud: 4800, sentences: { GGA: 5, HDT: 10 } } }"),
      Contains(
          "outputs.nav.sentences: what leaves needs 690 bytes/s, and a line of 4800 baud carries 480; allowed: fewer "
          "sentences, or 9600 baud"));
  CHECK_THROWS_WITH(read("outputs: { nav: { serial: /dev/ttyUSB0, baud: 9601 } }"), Contains("outputs.nav.baud: 9601"));
}

TEST_CASE("mistakes of outputs have a place, a cause and what is allowed") {
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, sentences: { GGB: 5 } } }"),
                    Contains("GGB") && Contains("GGA"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, sentences: {} } }"),
                    Contains("names no sentence; allowed: ZDA, GGA"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, sentences: { GGA: 0 } } }"),
                    Contains("outputs.nav.sentences.GGA: 0"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 0 } }"), Contains("outputs.nav.udp: 0"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, to: ship } }"),
                    Contains("outputs.nav.to: \"ship\" is no host"));
  CHECK_THROWS_WITH(read("outputs: { nav: { tcp: 10110, of: ship } }"),
                    Contains("outputs.nav.of: \"ship\" is no host"));
  CHECK_THROWS_WITH(read("outputs: { nav: { tcp_server: 10110, receivers: ['::1', ship] } }"),
                    Contains("outputs.nav.receivers: \"ship\" is no address"));
  CHECK_NOTHROW(read("outputs: { nav: { udp: 10110, to: 'fd00::7' }, plot: { tcp: 4001, of: '[::1]' } }"));
  CHECK_THROWS_WITH(read("outputs: { nav: { format: nmea } }"), Contains("needs one of"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, talker: gp } }"), Contains("two capital letters"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, format: tss1, sentences: { GGA: 1 } } }"),
                    Contains("outputs.nav.sentences: are those of format nmea"));
  CHECK_THROWS_WITH(read("outputs: { nav: { udp: 10110, rate_hz: 5 } }"),
                    Contains("outputs.nav.rate_hz: is that of other"));
}

TEST_CASE("sentences that a file names stand for all of the usual ones") {
  const auto parameters = read("outputs: { nav: { udp: 4000, to: 10.0.0.7, sentences: { HDT: 10, GGA: 0.5 } } }");
  REQUIRE(parameters.outputs.size() == 1);
  const SentenceRates& rates = parameters.outputs[0].sentences;
  REQUIRE(rates.size() == 2);
  CHECK(rates[0].first.kind == nav_out::Kind::kGga);
  CHECK(rates[0].second == 0.5);
  CHECK(rates[1].first.kind == nav_out::Kind::kHdt);
  CHECK(NavOutParameters{}.outputs[0].sentences.size() == 5);
}
