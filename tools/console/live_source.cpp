#include <algorithm>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/observer.h"
#include "components/runtime/clock_client.h"
#include "components/runtime/declared.h"
#include "components/runtime/run_finder.h"
#include "messages/declarations.h"
#include "tools/console/source.h"

namespace ensonify::console {

namespace {

using std::chrono::milliseconds;

constexpr int kQueue = 200;               // messages of a topic that wait for us
constexpr milliseconds kAskAgain{200};    // for a run that is not there yet
constexpr milliseconds kLookAgain{1000};  // whether it still is
constexpr const char* kScenarioFact = "scenario";
constexpr const char* kBeamAxis = "down";  // of heads that declare none

/// What the clock says of a run, asked in a thread of its own: a run that is busy may take seconds to answer.
struct Joined {
  LiveRun run;
  RunRegistry registry;
  std::optional<bus::Keys> keys;
  std::map<std::string, std::string> axes;  // by head
  std::string scenario;
  std::string state;
  double rate = 0.0;
};

/// Nothing while there is no such run, or it is still connecting.
std::optional<Joined> join(const std::string& name) {
  try {
    Joined joined;
    joined.run = find_run(name);
    ClockClient clock(joined.run);
    const auto status = clock.ask({{"kind", "status"}});
    if (status.at("state") == "connecting") return std::nullopt;
    joined.registry = clock.registry();
    joined.keys = clock.keys();
    const auto facts = clock.ask({{"kind", "get"}}).at("facts");
    if (std::find(facts.begin(), facts.end(), kDeclarationsFact) != facts.end()) {
      const std::string text = clock.ask({{"kind", "get"}, {"what", kDeclarationsFact}}).at("text");
      for (const auto& [head, declaration] : declared<msg::HeadDeclaration>(text))
        joined.axes[head] = declaration.beam_axis;
    }
    if (std::find(facts.begin(), facts.end(), kScenarioFact) != facts.end())
      joined.scenario = clock.ask({{"kind", "get"}, {"what", kScenarioFact}}).at("text");
    return joined;
  } catch (const std::exception&) {
    return std::nullopt;  // not there, or gone while it was asked
  }
}

struct Look {
  bool there = false;
  std::string state;
  double rate = 0.0;
};

Look look_at(const LiveRun& run) {
  try {
    ClockClient clock(run);
    const auto status = clock.ask({{"kind", "status"}});
    Look look{true, status.at("state"), 0.0};
    if (status.contains("rate") && status.at("rate").is_number()) look.rate = status.at("rate");
    return look;
  } catch (const std::exception&) {
    return {};
  }
}

template <class T>
bool is_ready(std::future<T>& future) {
  return future.valid() && future.wait_for(milliseconds(0)) == std::future_status::ready;
}

class LiveSource : public Source {
 public:
  explicit LiveSource(std::string run) : name_(std::move(run)) {}

  msg::ConsoleState state() const override {
    msg::ConsoleState state;
    state.kind = "run";
    state.name = run_ ? run_->run.id() : name_;
    state.state = run_ ? state_ : ended_ ? "ended" : "waiting";
    state.speed = rate_;
    if (!run_) {
      state.message = ended_ ? "the run has ended" : "no such run yet: " + name_;
      state.topics = topics_;
      state.launch = launch_;
      return state;
    }
    state.message = error_;
    state.launch = launch_;
    state.topics = topics_;
    return state;
  }

  std::string beam_axis(const std::string& publisher) const override {
    const auto axis = axes_.find(publisher);
    return axis == axes_.end() ? kBeamAxis : axis->second;
  }

  std::string folder() const override { return folder_; }
  std::string scenario() const override { return run_ ? run_->scenario : ""; }

  void want(const std::set<std::string>& topics) override {
    wanted_ = topics;
    connect();
  }

  void poll(WallTime now, milliseconds budget, const Take& take) override {
    if (is_ready(joining_)) begin(joining_.get(), now);
    if (is_ready(looking_)) note(looking_.get());
    if (is_ready(commanding_)) {
      error_ = commanding_.get();
      due_ = now;
    }
    if (!run_ && !joining_.valid() && now >= due_) {
      joining_ = std::async(std::launch::async, join, name_);
      due_ = now + kAskAgain;
    }
    if (run_ && !looking_.valid() && now >= due_) {
      looking_ = std::async(std::launch::async, look_at, run_->run);
      due_ = now + kLookAgain;
    }
    const WallTime until = now + budget;
    const WallTime at_once = std::chrono::steady_clock::now();
    // Round and round, so that a topic with much to say leaves the others their turn.
    bool more = true;
    while (more && std::chrono::steady_clock::now() < until) {
      more = false;
      for (auto& [topic, observer] : observers_) {
        auto packet = observer->next(at_once);
        if (!packet) continue;
        more = true;
        take(std::move(*packet));
      }
    }
  }

  void command(const msg::ConsoleCommand& command) override {
    if (!run_) throw UserError("there is no run to command");
    if (commanding_.valid()) throw UserError("the command before this one is still under way");
    nlohmann::json request{{"kind", command.command}};
    if (command.command == "rate") request["rate"] = command.rate;
    commanding_ = std::async(std::launch::async, [run = run_->run, request]() -> std::string {
      try {
        ClockClient(run).ask(request);
        return "";
      } catch (const std::exception& e) {
        return e.what();
      }
    });
  }

 private:
  void begin(std::optional<Joined> joined, WallTime now) {
    due_ = now + kAskAgain;
    if (!joined) return;
    run_ = std::move(joined);
    ended_ = false;
    state_ = "running";
    launch_ = run_->run.about.launch;
    folder_ = run_->run.about.out;
    axes_ = run_->axes;
    topics_.clear();
    for (const TopicEntry& topic : run_->registry.topics)
      topics_.push_back({topic.name, topic.type, topic.publisher, topic.component});
    due_ = now;  // its state
    connect();
  }

  void note(const Look& look) {
    if (!run_) return;
    if (look.there) {
      state_ = look.state == "done" || look.state == "failed" ? "ended" : look.state;
      rate_ = look.rate;
      return;
    }
    run_.reset();
    observers_.clear();
    ended_ = true;
  }

  void connect() {
    if (!run_) return;
    std::erase_if(observers_, [&](const auto& entry) { return !wanted_.contains(entry.first); });
    for (const TopicEntry& topic : run_->registry.topics) {
      if (!wanted_.contains(topic.name) || observers_.contains(topic.name)) continue;
      const std::vector<bus::Observer::Topic> one{{topic.name, topic.endpoint}};
      observers_.emplace(topic.name, std::make_unique<bus::Observer>(one, run_->keys, kQueue));
    }
  }

  std::string name_;
  std::optional<Joined> run_;
  bool ended_ = false;
  std::string state_;
  std::string launch_;
  std::string folder_;
  double rate_ = 0.0;
  std::vector<msg::ConsoleTopic> topics_;
  std::map<std::string, std::string> axes_;
  std::set<std::string> wanted_;
  std::map<std::string, std::unique_ptr<bus::Observer>> observers_;  // one a topic: they come and go one by one
  std::future<std::optional<Joined>> joining_;
  std::future<Look> looking_;
  std::future<std::string> commanding_;
  std::string error_;  // of the last command
  WallTime due_;       // of the next question
};

}  // namespace

std::unique_ptr<Source> live_source(const std::string& run) { return std::make_unique<LiveSource>(run); }

}  // namespace ensonify::console
