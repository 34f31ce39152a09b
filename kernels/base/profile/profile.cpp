#include "kernels/base/profile/profile.h"

#include <algorithm>
#include <ctime>
#include <memory>
#include <mutex>

namespace ensonify::profile {
namespace {

std::int64_t now_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

clockid_t processor_clock(Stage stage) { return is_part(stage) ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID; }

/// Of one thread; nobody else writes it.
struct Log {
  std::array<Sum, kStages> sums{};
  std::vector<Event> events;
  std::size_t events_left_out = 0;
};

struct Logs {
  std::mutex mutex;
  std::vector<std::unique_ptr<Log>> of_threads;  // they outlive their threads
  std::int64_t begin_ns = 0, processor_ns = 0;
};

Logs& logs() {
  static Logs all;
  return all;
}

Log& log_of_this_thread() {
  thread_local Log* own = nullptr;
  if (own == nullptr) {
    const std::lock_guard lock(logs().mutex);
    own = logs().of_threads.emplace_back(std::make_unique<Log>()).get();
  }
  return *own;
}

}  // namespace

namespace detail {

Opened open(Stage stage) { return {now_ns(CLOCK_MONOTONIC), now_ns(processor_clock(stage))}; }

void close(Stage stage, const Opened& opened, std::size_t items) {
  Log& log = log_of_this_thread();
  const std::int64_t took_ns = now_ns(CLOCK_MONOTONIC) - opened.wall_ns;
  Sum& sum = log.sums[static_cast<std::size_t>(stage)];
  ++sum.count;
  sum.items += static_cast<std::int64_t>(items);
  sum.wall_ns += took_ns;
  sum.processor_ns += now_ns(processor_clock(stage)) - opened.processor_ns;
  if (is_part(stage)) return;
  if (log.events.size() < kMostEvents) log.events.push_back({stage, opened.wall_ns, took_ns});
  else ++log.events_left_out;
}

}  // namespace detail

void start() {
  logs().begin_ns = now_ns(CLOCK_MONOTONIC);
  logs().processor_ns = now_ns(CLOCK_PROCESS_CPUTIME_ID);
  detail::on = true;
}

Report report() {
  const std::lock_guard lock(logs().mutex);
  Report all;
  all.begin_ns = logs().begin_ns;
  all.end_ns = now_ns(CLOCK_MONOTONIC);
  all.processor_ns = now_ns(CLOCK_PROCESS_CPUTIME_ID) - logs().processor_ns;
  for (const auto& log : logs().of_threads) {
    for (std::size_t i = 0; i < kStages; ++i) {
      all.sums[i].count += log->sums[i].count;
      all.sums[i].items += log->sums[i].items;
      all.sums[i].wall_ns += log->sums[i].wall_ns;
      all.sums[i].processor_ns += log->sums[i].processor_ns;
    }
    all.events.insert(all.events.end(), log->events.begin(), log->events.end());
    all.events_left_out += log->events_left_out;
  }
  std::ranges::sort(all.events, {}, &Event::begin_ns);
  if (all.events.size() <= kMostEvents) return all;
  all.events_left_out += all.events.size() - kMostEvents;
  all.events.resize(kMostEvents);
  return all;
}

}  // namespace ensonify::profile
