#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace ensonify::trace {

/// Way of an echo between the head and what sends it.
enum class EchoPath : std::uint8_t {
  kDirect,
  kViaSurface,  // out or back by way of the surface
  kViaBottom    // by way of the surface and the seabed
};
inline constexpr std::uint32_t kPaths = 3;

/// Source of sound in a ping.
struct Contributor {
  enum class Kind : std::uint8_t { kNoise, kSediment, kBody };

  Kind kind = Kind::kNoise;
  std::uint32_t instance = 0;     // of a label: of a sediment its class, of a body its own
  std::uint32_t label_class = 0;  // of a label
  std::uint8_t sediment = 0;      // class by whose law it scatters
  EchoPath path = EchoPath::kDirect;

  bool operator==(const Contributor&) const = default;
};

/// Index of noise, and of what nothing in the table sends: other heads, the surface overhead.
inline constexpr std::uint32_t kNoise = 0;

/// Index of the direct echo of a sediment, and of a body by its number.
constexpr std::uint32_t sediment_contributor(std::uint8_t sediment) { return 1 + kPaths * sediment; }
constexpr std::uint32_t body_contributor(std::uint32_t body) { return 1 + kPaths * (256 + body); }

/// Whether an index is one of a body's.
constexpr bool is_body(std::uint32_t contributor) { return contributor >= body_contributor(0); }

/// For rays that go on behind something: behind every body.
inline constexpr std::uint32_t kAllBodies = std::numeric_limits<std::uint32_t>::max();

/// Index of the same source by a path; noise stays noise.
constexpr std::uint32_t by_path(std::uint32_t contributor, EchoPath path) {
  return contributor == kNoise ? kNoise : contributor - (contributor - 1) % kPaths + static_cast<std::uint32_t>(path);
}

/// Contributors of a ping: hits and echoes carry an index. Entry 0 is noise; then each source has as many entries as
/// there are paths: first all sediment classes, then the bodies that the scene holds, by number. An index does not
/// depend on what else there is, so it means the same in every ping of a run.
class Contributors {
 public:
  /// All sediment classes, and no body.
  Contributors() : all_(1) {
    for (unsigned sediment = 0; sediment < 256; ++sediment) {
      add({Contributor::Kind::kSediment, sediment, 0, static_cast<std::uint8_t>(sediment)});
    }
  }

  /// Those of a body that is not there yet are noise.
  void set_body(std::uint32_t number, std::uint32_t instance, std::uint32_t label_class, std::uint8_t sediment) {
    while (all_.size() < body_contributor(number + 1)) all_.emplace_back();
    for (std::uint32_t path = 0; path < kPaths; ++path) {
      all_[body_contributor(number) + path] = {Contributor::Kind::kBody, instance, label_class, sediment,
                                               static_cast<EchoPath>(path)};
    }
  }

  std::size_t size() const { return all_.size(); }
  const Contributor& operator[](std::uint32_t index) const { return all_[index]; }

 private:
  void add(Contributor source) {
    for (std::uint32_t path = 0; path < kPaths; ++path) {
      source.path = static_cast<EchoPath>(path);
      all_.push_back(source);
    }
  }

  std::vector<Contributor> all_;
};

}  // namespace ensonify::trace
