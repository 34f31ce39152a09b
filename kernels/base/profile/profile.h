#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Where the time of a process goes, by stage of its work. Off until start(): then a span is one test of a flag. On, it
/// reads the machine's clock and the processor's at its beginning and at its end.
namespace ensonify::profile {

enum class Stage : std::uint8_t {
  kStep,  // an event of a node, all of it; what no other stage has is the rest
  // Of a head, one after another.
  kProbes,
  kRays,  // planned and aimed
  kTrace,
  kWeigh,
  kMerge,
  kEchoes,
  kPatterns,  // of receivers, for each echo
  kBeamform,  // all of it
  kDetection,
  kPlacing,
  kMessage,  // samples made and sent
  kLabels,   // all of them
  // Within beamforming, by the threads that do it.
  kSpread,
  kTransforms,
  kNoise,
};
inline constexpr std::size_t kStages = static_cast<std::size_t>(Stage::kNoise) + 1;
inline constexpr std::array<const char*, kStages> kStageNames{
    "step",     "probes",    "rays",    "trace",   "weigh",  "merge",  "echoes",     "patterns",
    "beamform", "detection", "placing", "message", "labels", "spread", "transforms", "noise"};
/// Whether a stage is a part of another that several threads share: summed over them, and no event of its own.
constexpr bool is_part(Stage stage) { return stage >= Stage::kSpread; }

struct Sum {
  std::int64_t count = 0;
  std::int64_t wall_ns = 0;
  std::int64_t processor_ns = 0;  // of all threads of the process meanwhile; of a part, its own thread
  std::int64_t items = 0;         // that it worked on: rays that were traced, scatterers that echo
};
struct Event {
  Stage stage{};
  std::int64_t begin_ns = 0, duration_ns = 0;  // of the machine's monotonic clock
};
struct Report {
  std::array<Sum, kStages> sums{};
  std::vector<Event> events;  // the first kMostEvents
  std::size_t events_left_out = 0;
  std::int64_t begin_ns = 0, end_ns = 0, processor_ns = 0;  // of all that was measured
};
inline constexpr std::size_t kMostEvents = 200'000;

/// Begins to measure, once in a process.
void start();
/// All that was measured since. Only when no span is open.
Report report();

namespace detail {
inline std::atomic<bool> on{false};
struct Opened {
  std::int64_t wall_ns = 0, processor_ns = 0;
};
Opened open(Stage stage);
void close(Stage stage, const Opened& opened, std::size_t items);
}  // namespace detail

/// Whether measuring has begun.
inline bool measured() { return detail::on.load(std::memory_order_relaxed); }

/// Time from here to the end of the block, and how many items are worked on in it.
class Span {
 public:
  explicit Span(Stage stage, std::size_t items = 0)
      : stage_(stage), items_(items), measured_(detail::on.load(std::memory_order_relaxed)) {
    if (measured_) opened_ = detail::open(stage);
  }
  ~Span() {
    if (measured_) detail::close(stage_, opened_, items_);
  }
  Span(const Span&) = delete;
  Span& operator=(const Span&) = delete;

 private:
  Stage stage_;
  std::size_t items_;
  bool measured_;
  detail::Opened opened_;
};

}  // namespace ensonify::profile
