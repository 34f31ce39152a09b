#include "components/runtime/protocol.h"

#include <catch2/catch.hpp>

using namespace ensonify;

TEST_CASE("grant and done survive their bytes") {
  protocol::Grant grant{3, 123456789_ms, {{7, 42}, {8, 0}}};
  const auto grant_back = protocol::read_grant(protocol::encode(grant));
  REQUIRE(grant_back);
  CHECK(grant_back->epoch == 3);
  CHECK(grant_back->horizon == grant.horizon);
  CHECK(grant_back->inputs == grant.inputs);
  const auto done_back = protocol::read_done(protocol::encode(protocol::Done{3, kNever, true, 99, {{1, 5}}}));
  REQUIRE(done_back);
  CHECK(done_back->next == kNever);
  CHECK(done_back->finish);
  CHECK(done_back->outputs == protocol::TopicCounts{{1, 5}});
}

TEST_CASE("every truncation and every excess byte of a grant is refused") {
  const std::string whole = protocol::encode(protocol::Grant{1, 5_s, {{7, 42}}});
  for (std::size_t n = 0; n < whole.size(); ++n) CHECK_FALSE(protocol::read_grant(whole.substr(0, n)));
  CHECK_FALSE(protocol::read_grant(whole + "x"));
}

TEST_CASE("ports survive their JSON") {
  const Declaration d{
      "bow", "multibeam", {{"ping", "ping/1", 2'000'000, {10, 1}}}, {{"pose", "pose/1", 5_ms, true, {}, 0}}, true};
  const Declaration back = protocol::read_declaration(protocol::declaration_json(d));
  CHECK(back.process == "bow");
  CHECK(back.may_finish);
  CHECK(back.outs.at(0).rate == Rate{10, 1});
  CHECK(back.outs.at(0).max_bytes == 2'000'000);
  CHECK(back.ins.at(0).delay == 5_ms);
  CHECK(back.ins.at(0).optional);
}

TEST_CASE("what is not a control message is reported, without a crash") {
  CHECK(protocol::kind_of("") == "");
  CHECK(protocol::kind_of("nonsense") == "");
  CHECK(protocol::kind_of("{\"kind\":5}") == "");
  CHECK_THROWS(protocol::read_hello("{}"));
  CHECK_THROWS(protocol::read_hello("[1,2]"));
}
