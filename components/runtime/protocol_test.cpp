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

TEST_CASE("the beginning of an epoch survives its JSON, and a wrong field of it is named") {
  const auto back = protocol::read_epoch(protocol::encode(protocol::Begin{7, {"seed=3", "a.b=\"x\""}, "/tmp/out"}));
  CHECK(back.epoch == 7);
  CHECK(back.sets == std::vector<std::string>{"seed=3", "a.b=\"x\""});
  CHECK(back.out == "/tmp/out");
  CHECK_THROWS_WITH(protocol::read_epoch(R"({"epoch":-1,"set":[],"out":""})"), Catch::Contains("epoch"));
  CHECK_THROWS_WITH(protocol::read_epoch(R"({"epoch":2,"set":"seed=1","out":""})"), Catch::Contains("set"));
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

TEST_CASE("ports for viewers stand apart in a HELLO, and are no output as well") {
  Declaration d{"bow", "multibeam", {{"ping", "ping/1", 100, {10, 1}}}, {}, false};
  CHECK(protocol::declaration_json(d).find("live_only") == std::string::npos);
  d.lives = {{"view", "view/1", 5000}};
  const Declaration back = protocol::read_declaration(protocol::declaration_json(d));
  REQUIRE(back.lives.size() == 1);
  CHECK(back.lives[0].port == "view");
  CHECK(back.lives[0].type == "view/1");
  CHECK(back.lives[0].max_bytes == 5000);
  CHECK(back.outs.size() == 1);
  d.lives[0].port = "ping";
  CHECK_THROWS_WITH(protocol::read_declaration(protocol::declaration_json(d)),
                    "live_only[0].port: \"ping\" is an output as well");
  CHECK(protocol::read_late(protocol::encode_late(true)));
  CHECK_FALSE(protocol::read_late(protocol::encode_late(false)));
  CHECK(protocol::read_lost(protocol::encode_lost("agent")) == "agent");
}

TEST_CASE("what is not a control message is reported, without a crash") {
  CHECK(protocol::kind_of("") == "");
  CHECK(protocol::kind_of("nonsense") == "");
  CHECK(protocol::kind_of("{\"kind\":5}") == "");
  CHECK_THROWS(protocol::read_hello("{}"));
  CHECK_THROWS(protocol::read_hello("[1,2]"));
}

TEST_CASE("a HELLO with a wrong field is refused, and the field named") {
  const std::string good = R"({"name":"a","out":[OUT],"in":[IN],"sync":"ipc:///x","live":"ipc:///y"MORE})";
  const std::string port = R"("port":"x","type":"x/1")";
  const auto hello = [&](const std::string& out, const std::string& in, const std::string& more) {
    std::string text = good;
    for (const auto& [word, value] : {std::pair<std::string, std::string>{"OUT", out}, {"IN", in}, {"MORE", more}})
      text.replace(text.find(word), word.size(), value);
    return text;
  };
  CHECK(
      protocol::read_hello(hello("{" + port + R"(,"rate":[10000,1]})", "{" + port + "}", "")).declaration.outs.size() ==
      1);
  const auto refused = [&](const std::string& text, const std::string& field) {
    CHECK_THROWS_WITH(protocol::read_hello(text), Catch::Contains(field));
  };
  refused(hello("", "", R"(,"pid":"1")"), "pid: is not an integer");
  refused(hello("", "", R"(,"pid":18446744073709551615)"), "pid: is not an integer in range");
  refused(hello("", "", R"(,"may_finish":1)"), "may_finish: is not true or false");
  refused(hello("", "", R"(,"facts":{"a":1})"), "facts: is not a map of texts");
  refused(hello("", "", R"(,"declares":{"a":"1"})"), "declares: is not a map of maps");
  refused(hello("", "", R"(,"declares":{"head_declaration/1":{"reach_m":"far"}})"),
          "declares.head_declaration/1.reach_m: is not a number");
  std::string deep = "1";
  for (int i = 0; i < 20'000; ++i) deep = R"({"a":)" + deep + "}";
  refused(hello("", "", R"(,"declares":{"x/1":)" + deep + "}"), "declares.x/1: is nested deeper than 16");
  refused(hello("", "", R"(,"declares":{"x/1":{"a":")" + std::string(1 << 20, 'a') + "\"}}"),
          "declares.x/1: is longer");
  refused(hello("5", "", ""), "out: is not a list of ports");
  std::string many = "{" + port + "}";
  for (int i = 0; i < 1000; ++i) many += ",{" + port + "}";
  refused(hello(many, "", ""), "out: has more than 1000 ports");
  refused(hello(R"({"type":"x/1"})", "", ""), "out[0].port: is missing");
  refused(hello(R"({"port":"a b","type":"x/1"})", "", ""), "out[0].port: \"a b\" is not a name");
  refused(hello(R"({"port":"a"})", "", ""), "out[0].type: is missing");
  for (const char* rate : {"10", "[10]", "[1.5,1]", "[10,0]", "[-1,1]", "[10001,1]", "[9223372036854775807,1]"})
    refused(hello("{" + port + R"(,"rate":)" + rate + "}", "", ""), "out[0].rate: is not two integers");
  refused(hello("", "{" + port + R"(,"least_rate":[10,0]})", ""), "in[0].least_rate: is not two integers");
  refused(hello("{" + port + R"(,"max_bytes":-1})", "", ""), "out[0].max_bytes: is not an integer in range");
  refused(hello("{" + port + R"(,"max_bytes":1099511627776})", "", ""), "out[0].max_bytes: is more than");
  refused(hello("", "{" + port + R"(,"delay_ns":-1})", ""), "in[0].delay_ns: is outside");
  refused(hello("", "{" + port + R"(,"optional":"no"})", ""), "in[0].optional: is not true or false");
  refused(hello("", "{" + port + R"(,"topics":[1]})", ""), "in[0].topics: is not a list of texts");
}

TEST_CASE("what a reader cannot use is a failure of its sender, with the event that notices") {
  const auto back = protocol::read_unusable(protocol::encode(protocol::Unusable{100_ms, {3, "no msgpack", "agent"}}));
  CHECK(back.at == 100_ms);
  CHECK(back.why.code == 3);
  CHECK(back.why.message == "no msgpack");
  CHECK(back.why.culprit == "agent");
  CHECK_THROWS_WITH(protocol::read_unusable(R"({"kind":"unusable","code":3,"culprit":"agent"})"), "t_ns: is missing");
}

TEST_CASE("a failure has a failure's code, or is none") {
  const auto back = protocol::read_failed(protocol::encode_failed({5, "gone", "agent"}));
  CHECK(back.code == 5);
  CHECK(back.message == "gone");
  CHECK(back.culprit == "agent");
  for (const char* text : {R"({"kind":"failed"})", R"({"kind":"failed","code":0})", R"({"kind":"failed","code":"3"})",
                           R"({"kind":"failed","code":99})", R"({"kind":"failed","code":3,"message":7})"})
    CHECK_THROWS(protocol::read_failed(text));
}
