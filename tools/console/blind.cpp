#include "tools/console/blind.h"

#include <algorithm>
#include <utility>

#include "messages/instrument.h"

namespace ensonify::console {

namespace {

class BlindSource : public Source {
 public:
  explicit BlindSource(std::unique_ptr<Source> source) : source_(std::move(source)) {}

  msg::ConsoleState state() const override {
    msg::ConsoleState state = source_->state();
    std::erase_if(state.topics,
                  [](const msg::ConsoleTopic& topic) { return !msg::is_instrument(topic.type).value_or(false); });
    return state;
  }
  std::string beam_axis(const std::string& publisher) const override { return source_->beam_axis(publisher); }
  void want(const std::set<std::string>& topics) override {
    const auto shown = state().topics;
    std::set<std::string> allowed;
    for (const msg::ConsoleTopic& topic : shown)
      if (topics.contains(topic.name)) allowed.insert(topic.name);
    source_->want(allowed);
  }
  std::string folder() const override { return ""; }
  std::string scenario() const override { return source_->scenario(); }
  void poll(WallTime now, std::chrono::milliseconds budget, const Take& take) override {
    source_->poll(now, budget, take);
  }
  void command(const msg::ConsoleCommand& command) override { source_->command(command); }

 private:
  std::unique_ptr<Source> source_;
};

}  // namespace

std::unique_ptr<Source> blind(std::unique_ptr<Source> source) {
  return std::make_unique<BlindSource>(std::move(source));
}

}  // namespace ensonify::console
