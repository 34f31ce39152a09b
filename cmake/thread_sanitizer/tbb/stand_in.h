#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

/// What the project uses of oneTBB, on plain threads: included in place of it by the preset tsan alone. TBB's own
/// library is not instrumented, so the sanitizer does not know what order it keeps between tasks, and would have to
/// ignore every task. Here it sees each thread begin and end, and nothing orders two tasks but that. Tasks within tasks
/// run one after another. It is slow: a call starts its threads.
namespace tbb {

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t most) : before_(allowed().exchange(most)) {}
  ~global_control() { allowed() = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

  static std::size_t active_value(parameter) { return allowed(); }
  static std::atomic<std::size_t>& allowed() {
    static std::atomic<std::size_t> most{4};  // more than the cores of a small machine: threads change places
    return most;
  }

 private:
  std::size_t before_;
};

namespace this_task_arena {
inline thread_local int thread_index = 0;
inline int max_concurrency() { return static_cast<int>(std::clamp<std::size_t>(global_control::allowed(), 1, 8)); }
inline int current_thread_index() { return thread_index; }
template <class Function>
auto isolate(const Function& function) {
  return function();
}
}  // namespace this_task_arena

namespace detail {

inline thread_local bool in_task = false;

/// Calls task(0), task(1), ... task(count - 1), each once, on several threads; throws what the first of them threw.
/// Thread n takes tasks n, n + threads, n + 2 threads, ...: handed out on demand, one thread might do them all, and no
/// two of them would be unordered.
template <class Task>
void run(std::size_t count, const Task& task) {
  const std::size_t threads = std::min(count, static_cast<std::size_t>(this_task_arena::max_concurrency()));
  if (in_task || threads < 2) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  std::atomic<bool> stopped{false};  // relaxed: it must not order tasks
  std::exception_ptr thrown;
  std::mutex mutex;
  const auto work = [&](std::size_t index) {
    this_task_arena::thread_index = static_cast<int>(index);
    in_task = true;
    try {
      for (std::size_t i = index; i < count && !stopped.load(std::memory_order_relaxed); i += threads) task(i);
    } catch (...) {
      stopped.store(true, std::memory_order_relaxed);
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
    in_task = false;
    this_task_arena::thread_index = 0;
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work, i);
  work(0);
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace detail

struct simple_partitioner {};

template <class Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  bool empty() const { return !(begin_ < end_); }
  bool is_divisible() const { return grain_ < size(); }
  /// The two halves, divided where TBB divides.
  std::pair<blocked_range, blocked_range> halves() const {
    const Index middle = begin_ + (end_ - begin_) / 2;
    return {{begin_, middle, grain_}, {middle, end_, grain_}};
  }

 private:
  Index begin_, end_;
  std::size_t grain_;
};

namespace detail {
template <class Index>
void divide(const blocked_range<Index>& range, std::vector<blocked_range<Index>>& parts) {
  if (range.empty()) return;
  if (!range.is_divisible()) return parts.push_back(range);
  const auto [left, right] = range.halves();
  divide(left, parts);
  divide(right, parts);
}

template <class Value, class Index, class Combine>
Value combine(const blocked_range<Index>& range, std::vector<Value>& values, std::size_t& next, const Combine& both) {
  if (!range.is_divisible()) return std::move(values[next++]);
  const auto [left, right] = range.halves();
  Value first = combine(left, values, next, both);
  return both(std::move(first), combine(right, values, next, both));
}
}  // namespace detail

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body, simple_partitioner = {}) {
  std::vector<blocked_range<Index>> parts;
  detail::divide(range, parts);
  detail::run(parts.size(), [&](std::size_t i) { body(parts[i]); });
}

template <class Index, class Body>
requires std::is_integral_v<Index>
void parallel_for(Index first, Index last, const Body& body) {
  if (!(first < last)) return;
  detail::run(static_cast<std::size_t>(last - first), [&](std::size_t i) { body(first + static_cast<Index>(i)); });
}

template <class Container, class Body>
void parallel_for_each(Container& items, const Body& body) {
  std::vector<decltype(&*std::begin(items))> each;
  for (auto& item : items) each.push_back(&item);
  detail::run(each.size(), [&](std::size_t i) { body(*each[i]); });
}

template <class... Functions>
void parallel_invoke(const Functions&... functions) {
  std::size_t number = 0;
  const auto call = [&](std::size_t wanted) {
    std::size_t i = 0;
    ((i++ == wanted ? functions() : void()), ...);
  };
  ((static_cast<void>(functions), ++number), ...);
  detail::run(number, call);
}

template <class Index, class Value, class Body, class Combine>
Value parallel_deterministic_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body,
                                    const Combine& both) {
  if (range.empty()) return identity;
  std::vector<blocked_range<Index>> parts;
  detail::divide(range, parts);
  std::vector<Value> values(parts.size(), identity);
  detail::run(parts.size(), [&](std::size_t i) { values[i] = body(parts[i], identity); });
  std::size_t next = 0;
  return detail::combine(range, values, next, both);
}

class flow_control {
 public:
  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }

 private:
  bool stopped_ = false;
};

enum class filter_mode { parallel, serial_in_order };

/// A stage of a pipeline; In is void of the first, Out of the last.
template <class In, class Out, class Function>
struct filter {
  Function function;
};
template <class In, class Out, class Function>
filter<In, Out, Function> make_filter(filter_mode, const Function& function) {
  return {function};
}

/// The one form that the project has: a source in order, work on several at a time, an end in order.
template <class Token, class Source, class Work>
struct two_filters {
  Source source;
  Work work;
};
template <class Token, class Result, class First, class Second>
auto operator&(const filter<void, Token, First>& source, const filter<Token, Result, Second>& work) {
  return two_filters<Token, First, Second>{source.function, work.function};
}
template <class Token, class Source, class Work, class End>
struct three_filters {
  Source source;
  Work work;
  End end;
};
template <class Token, class Result, class First, class Second, class Third>
auto operator&(const two_filters<Token, First, Second>& before, const filter<Result, void, Third>& end) {
  return three_filters<Token, First, Second, Third>{before.source, before.work, end.function};
}

/// While one comes to its end, others are worked on: never more than so many in all.
template <class Token, class Source, class Work, class End>
void parallel_pipeline(std::size_t most, const three_filters<Token, Source, Work, End>& stages) {
  using Result = decltype(stages.work(std::declval<Token>()));
  std::vector<Result> ready;
  flow_control flow;
  do {
    std::vector<Token> tokens;
    while (!flow.stopped() && ready.size() + tokens.size() < most) {
      Token token = stages.source(flow);
      if (!flow.stopped()) tokens.push_back(token);
    }
    const std::size_t ending = ready.empty() ? 0 : 1;
    std::vector<Result> worked(tokens.size());
    detail::run(ending + tokens.size(), [&](std::size_t i) {
      if (i < ending) stages.end(ready.front());
      else worked[i - ending] = stages.work(tokens[i - ending]);
    });
    if (ending > 0) ready.erase(ready.begin());
    ready.insert(ready.end(), worked.begin(), worked.end());
  } while (!ready.empty() || !flow.stopped());
}

}  // namespace tbb
