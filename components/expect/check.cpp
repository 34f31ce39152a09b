#include "components/expect/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/errors/assert.h"
#include "components/expect/same_as.h"

namespace ensonify::expect {
namespace {

using Kind = Expectation::Kind;

/// Finds the messages that an expectation is about, and knows whether there was anything to find.
class Matcher {
 public:
  explicit Matcher(Messages messages) : messages_(std::move(messages)) {}

  bool matches(const Observation& message) {
    if (message.topic() != messages_.topic) return false;
    ++seen_;
    if (!messages_.where) return true;
    const auto value = value_at(message.value(), messages_.where->field.path);
    if (!value) return false;
    ++valued_;
    return messages_.where->holds(*value);
  }

  /// Why nothing can be said; "" when something can.
  std::string silence() const {
    if (seen_ == 0) return "there was no message on " + messages_.topic;
    if (!messages_.where || valued_ > 0) return "";
    return fmt::format("{} had no value in {} messages on {}", messages_.where->field.path, seen_, messages_.topic);
  }
  bool seen() const { return seen_ > 0; }
  const Messages& messages() const { return messages_; }

 private:
  Messages messages_;
  std::int64_t seen_ = 0, valued_ = 0;
};

std::vector<Check::Field> field_of(const Messages& messages) {
  if (!messages.where) return {};
  return {{messages.topic, messages.where->field.path, messages.where->field.place}};
}

/// A check about the messages of one topic: fails once, or is judged at the end.
class OneTopic : public Check {
 public:
  explicit OneTopic(const Expectation& e) : e_(e), matcher_(e.messages) {}
  void see(const Observation& message) final {
    if (!failed_ && seconds(message.t()) >= e_.after_s && matcher_.matches(message)) see_match(message);
  }
  Verdict close(SimTime end) final { return failed_ ? *failed_ : judge(end); }
  std::vector<std::string> topics() const final { return {e_.messages.topic}; }
  std::vector<Field> fields() const override { return field_of(e_.messages); }

 protected:
  virtual void see_match(const Observation& message) = 0;
  virtual Verdict judge(SimTime end) = 0;

  void fail(SimTime t, std::string message) { failed_ = Verdict{false, t, std::move(message)}; }
  static Verdict failed(SimTime t, std::string message) { return {false, t, std::move(message)}; }
  static Verdict passed(SimTime t, std::string message) { return {true, t, std::move(message)}; }

  const Expectation e_;
  Matcher matcher_;

 private:
  std::optional<Verdict> failed_;
};

class Count : public OneTopic {
 public:
  using OneTopic::OneTopic;

 private:
  void see_match(const Observation& message) override {
    ++count_;
    if (e_.max && static_cast<double>(count_) > *e_.max) {
      fail(message.t(), fmt::format("message {} came; at most {} were expected", count_, *e_.max));
    }
  }
  Verdict judge(SimTime end) override {
    // That nothing came may be what was expected; that nothing could be compared never is.
    if (e_.messages.where && !matcher_.silence().empty()) return failed(end, matcher_.silence());
    if (e_.min && static_cast<double>(count_) < *e_.min) {
      return failed(end, fmt::format("{} messages came; at least {} were expected", count_, *e_.min));
    }
    return passed(end, fmt::format("{} messages", count_));
  }

  std::int64_t count_ = 0;
};

/// Messages from the first to the run's end, so that a topic that falls silent is noticed; one more or less is allowed.
class MeanRate : public OneTopic {
 public:
  using OneTopic::OneTopic;

 private:
  void see_match(const Observation& message) override {
    if (count_++ == 0) first_ = message.t();
  }
  Verdict judge(SimTime end) override {
    if (!matcher_.seen()) return failed(end, matcher_.silence());
    const double span_s = seconds(end - first_), expected = span_s * e_.hz;
    if (expected < 2.0) return failed(end, fmt::format("{} s are too short for a rate of {} Hz", span_s, e_.hz));
    const double hz = static_cast<double>(count_) / span_s;
    if (std::abs(static_cast<double>(count_) - expected) <= e_.tolerance * expected + 1.0) {
      return passed(end, fmt::format("{:.4g} Hz", hz));
    }
    return failed(end, fmt::format("{} messages in {:.3f} s are {:.4g} Hz; {} Hz within {:.4g} % were expected", count_,
                                   span_s, hz, e_.hz, 100.0 * e_.tolerance));
  }

  SimTime first_{0};
  std::int64_t count_ = 0;
};

class Bounds : public OneTopic {
 public:
  using OneTopic::OneTopic;
  std::vector<Field> fields() const override {
    auto fields = field_of(e_.messages);
    fields.push_back({e_.messages.topic, e_.field.path, e_.field.place});
    return fields;
  }

 private:
  void see_match(const Observation& message) override {
    ++matches_;
    const auto value = value_at(message.value(), e_.field.path);
    if (!value) return;
    const auto* number = std::get_if<double>(&*value);
    if (!number || std::isnan(*number) || (e_.min && *number < *e_.min) || (e_.max && *number > *e_.max)) {
      fail(message.t(), fmt::format("{} = {} (message {})", e_.field.path, text_of(*value), message.seq()));
      return;
    }
    ++values_;
    low_ = std::min(low_, *number);
    high_ = std::max(high_, *number);
  }
  Verdict judge(SimTime end) override {
    if (!matcher_.silence().empty()) return failed(end, matcher_.silence());
    if (matches_ == 0) return failed(end, "there was no " + e_.messages.text());
    if (values_ == 0) return failed(end, fmt::format("{} had no value in {} messages", e_.field.path, matches_));
    return passed(end, fmt::format("{} values in [{}, {}]", values_, low_, high_));
  }

  std::int64_t matches_ = 0, values_ = 0;
  double low_ = INFINITY, high_ = -INFINITY;
};

class Eventually : public OneTopic {
 public:
  using OneTopic::OneTopic;

 private:
  void see_match(const Observation& message) override {
    if (!first_) first_ = message.t();
  }
  Verdict judge(SimTime end) override {
    if (first_ && seconds(*first_) <= e_.within_s)
      return passed(*first_, "first at " + fmt::format("{:.3f} s", seconds(*first_)));
    const SimTime late = std::min(end, from_seconds(e_.within_s));
    if (first_) return failed(late, fmt::format("came only at {:.3f} s", seconds(*first_)));
    return failed(late, matcher_.silence().empty() ? "never came" : matcher_.silence());
  }

  std::optional<SimTime> first_;
};

class Never : public OneTopic {
 public:
  using OneTopic::OneTopic;

 private:
  void see_match(const Observation& message) override {
    fail(message.t(), fmt::format("came at {:.3f} s (message {})", seconds(message.t()), message.seq()));
  }
  Verdict judge(SimTime end) override {
    return matcher_.silence().empty() ? passed(end, "never came") : failed(end, matcher_.silence());
  }
};

class NoGap : public OneTopic {
 public:
  using OneTopic::OneTopic;

 private:
  void see_match(const Observation& message) override {
    if (message.seq() != next_) {
      fail(message.t(), fmt::format("message {} came where {} was due", message.seq(), next_));
    }
    next_ = message.seq() + 1;
  }
  Verdict judge(SimTime end) override {
    return matcher_.seen() ? passed(end, fmt::format("{} messages", next_)) : failed(end, matcher_.silence());
  }

  std::uint64_t next_ = 0;
};

class Order : public Check {
 public:
  explicit Order(const Expectation& e) : first_(e.messages), then_(e.then) {}
  void see(const Observation& message) override {
    const bool first = first_.matches(message), then = then_.matches(message);
    if (then && !then_at_) then_at_ = message.t(), in_order_ = first_at_.has_value();
    if (first && !first_at_) first_at_ = message.t();
  }
  Verdict close(SimTime end) override {
    const auto missing = [&](const Matcher& m) {
      return Verdict{false, end, m.silence().empty() ? m.messages().text() + " never came" : m.silence()};
    };
    if (!then_at_) return missing(then_);
    if (!first_at_) return missing(first_);
    const std::string times = fmt::format("{} at {:.3f} s, {} at {:.3f} s", first_.messages().text(),
                                          seconds(*first_at_), then_.messages().text(), seconds(*then_at_));
    return {in_order_, *then_at_, times};
  }
  std::vector<std::string> topics() const override { return {first_.messages().topic, then_.messages().topic}; }
  std::vector<Field> fields() const override {
    auto fields = field_of(first_.messages());
    for (Field& field : field_of(then_.messages())) fields.push_back(std::move(field));
    return fields;
  }

 private:
  Matcher first_, then_;
  std::optional<SimTime> first_at_, then_at_;
  bool in_order_ = false;
};

}  // namespace

std::unique_ptr<Check> make_check(const Expectation& e) {
  switch (e.kind) {
    case Kind::kCount: return std::make_unique<Count>(e);
    case Kind::kRate: return std::make_unique<MeanRate>(e);
    case Kind::kBounds: return std::make_unique<Bounds>(e);
    case Kind::kEventually: return std::make_unique<Eventually>(e);
    case Kind::kNeverSeen: return std::make_unique<Never>(e);
    case Kind::kOrder: return std::make_unique<Order>(e);
    case Kind::kNoGap: return std::make_unique<NoGap>(e);
    case Kind::kSameAs: return make_same_as(e);
  }
  ENSONIFY_ASSERT(false, "an expectation of no kind");
}

}  // namespace ensonify::expect
