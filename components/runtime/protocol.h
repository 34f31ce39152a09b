#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "components/runtime/stepper.h"
#include "components/runtime/wiring.h"

/// Control messages between clock and participants: docs/manual/wire.md, as structs and text. No sockets here.
namespace ensonify::protocol {

struct Hello {
  Declaration declaration;
  std::int64_t pid = 0;
  std::uint32_t epoch = 1;  // that it joins
  bool resets = false;      // can begin another epoch
  SimTime first{0};
  std::string sync_endpoint;
  std::string live_endpoint;
  std::map<std::string, std::string> facts;
};

struct WelcomeIn {
  Feed feed;
  std::string endpoint;
  std::string token;
};
struct Welcome {
  std::uint32_t epoch = 1;
  std::uint32_t rank = 0;
  double patience_s = 50.0;  // how long what a GRANT counts may take to arrive, wall time
  std::vector<OutTopic> outs;
  std::vector<std::vector<std::string>> out_tokens;  // per out: one for each subscriber to come
  std::vector<WelcomeIn> ins;
  std::map<std::string, std::string> facts;  // "launch", "scenario", "version"
};

/// An epoch begins: whoever takes part ends the one before, and says HELLO again.
struct Begin {
  std::uint32_t epoch = 2;
  std::vector<std::string> sets;  // as --set takes them, behind those of the launch
  std::string out;                // folder of its results
};

using TopicCounts = std::vector<std::pair<std::uint32_t, std::uint64_t>>;  // topic id, messages so far

struct Grant {
  std::uint32_t epoch = 1;
  SimTime horizon{0};
  TopicCounts inputs;
};

struct Done {
  std::uint32_t epoch = 1;
  SimTime next{0};
  bool finish = false;  // the run is to end kFinishMargin after the event at next - 1 ns
  std::int64_t cost_ns = 0;
  TopicCounts outputs;
};

/// Why a participant leaves.
struct Failed {
  int code = 0;
  std::string message;
  std::string culprit;  // the process whose message could not be used; "": its own doing
};

/// A reader takes nothing more of a topic, since its event at `at`: its publisher, which the run may lose, is to go.
struct Unusable {
  SimTime at{0};
  Failed why;
};

/// Ports as the JSON that `--check` prints and HELLO carries, and back. Reading throws std::runtime_error naming the
/// key.
std::string declaration_json(const Declaration& declaration);
Declaration read_declaration(std::string_view json);

std::string encode(const Hello& hello);
std::string encode(const Welcome& welcome, const Declaration& declaration);
std::string encode(const Grant& grant);
std::string encode(const Done& done);

/// The `kind` of a JSON message; "grant" and "done" for the binary ones; "" for anything else.
std::string kind_of(std::string_view text);
Hello read_hello(std::string_view json);
/// `ins` are the reader's own ports, to find each port's index.
Welcome read_welcome(std::string_view json, const std::vector<OutPort>& outs, const std::vector<InPort>& ins);
std::optional<Grant> read_grant(std::string_view bytes);
std::optional<Done> read_done(std::string_view bytes);

/// {"kind":"epoch","epoch":2,"set":[..],"out":".."}
std::string encode(const Begin& begin);
Begin read_epoch(std::string_view json);
/// {"kind":"late","late":true}
std::string encode_late(bool late);
bool read_late(std::string_view json);
/// {"kind":"lost","process":..}: nothing more will come of it than the grants count.
std::string encode_lost(const std::string& process);
std::string read_lost(std::string_view json);
/// {"kind":"failed","code":..,"message":..,"culprit":..}
std::string encode_failed(const Failed& failed);
Failed read_failed(std::string_view json);
/// {"kind":"unusable","t_ns":..,"code":..,"message":..,"culprit":..}
std::string encode(const Unusable& unusable);
Unusable read_unusable(std::string_view json);
/// {"kind":"proven","tokens":[..]}
std::string encode_proven(const std::vector<std::string>& tokens);
std::vector<std::string> read_tokens(std::string_view json);
/// {"kind":"refused","problems":[..]}
std::string encode_refused(const std::vector<std::string>& problems);
/// The texts under "problems" of a refusal.
std::vector<std::string> read_problems(std::string_view json);
/// {"kind":"bye","code":..}: the process's own exit code, 0 where it says none.
std::string encode_bye(int code);
/// "code" of an end, or of a bye.
int read_code(std::string_view json);

}  // namespace ensonify::protocol
