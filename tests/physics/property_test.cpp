#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "components/echosounder/node.h"
#include "components/forward_looking/node.h"
#include "components/multibeam/node.h"
#include "components/scanning/node.h"
#include "components/sidescan/node.h"
#include "components/sonar/testing/seabed.h"
#include "kernels/acoustics/array/shading.h"
#include "kernels/base/random/stream.h"
#include "tests/physics/heads.h"

// Laws that hold for any legal head, at any place, over any seabed: random ones, always the same.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

/// Numbers for one case: the n-th one asked for.
class Draws {
 public:
  explicit Draws(std::uint64_t number) : number_(number) {}
  double between(double low, double high) { return low + (high - low) * stream_.uniform(number_, next_++); }
  /// Spread evenly over orders of magnitude.
  double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int whole(int low, int high) { return static_cast<int>(between(low, high + 1)); }
  bool yes() { return between(0.0, 1.0) < 0.5; }

 private:
  random::Stream stream_{1, "cases"};
  std::uint64_t number_, next_ = 0;
};

std::string effects_yaml(Draws& draw) {
  std::string yaml = "effects:\n";
  for (const char* effect : {"refraction", "absorption", "directivity", "side_lobes", "speckle", "noise", "volume",
                             "multipath", "motion", "tvg", "quantisation"}) {
    yaml += fmt::format("  {}: {}\n", effect, draw.between(0, 1) < 0.8);
  }
  return yaml;
}

std::string lod_yaml(Draws& draw) {
  return fmt::format("lod: {{ enabled: {}, side_lobes: {} }}\n", draw.yes(), draw.whole(0, 5));
}

/// The length of a pulse, and half of the time the sweep that makes a chirp of it.
struct RandomPulse {
  double length_s, band_hz;
  std::string yaml;
};
RandomPulse random_pulse(Draws& draw, const char* indent) {
  const char* const windows[] = {"none", "hann", "hamming", "blackman"};
  RandomPulse pulse{draw.scale(3e-5, 1e-3), 0.0, {}};
  const double sweep_hz = draw.between(4.1, 6.0) / pulse.length_s;
  const bool chirp = draw.yes();
  pulse.band_hz = chirp ? sweep_hz : 1.0 / pulse.length_s;
  pulse.yaml = fmt::format("{}pulse_length_s: {}\n", indent, pulse.length_s);
  if (chirp) {
    pulse.yaml += fmt::format("{0}pulse: chirp\n{0}bandwidth_hz: {1}\n{0}window: {2}\n", indent, sweep_hz,
                              windows[draw.whole(0, 3)]);
  } else {
    pulse.yaml += fmt::format("{}pulse: tone\n", indent);
  }
  return pulse;
}

std::string shading_yaml(Draws& draw, const char* key) {
  const char* const windows[] = {"uniform", "hann", "hamming", "dolph_chebyshev", "taylor"};
  const double side_lobe_db = draw.between(13, 60);
  return fmt::format("{}: {{ window: {}, side_lobe_db: {}, nbar: {} }}\n", key, windows[draw.whole(0, 4)], side_lobe_db,
                     draw.whole(array::least_nbar(side_lobe_db), 20));
}

// Ranges and samples are kept small, for speed; all else goes to the ends of what the heads' readers allow.

std::string multibeam_yaml(Draws& draw) {
  const RandomPulse pulse = random_pulse(draw, "");
  const char* const spacings[] = {"equiangle", "equidistant", "high_density"};
  std::string yaml = fmt::format(
      "frequency_hz: {}\nbeams: {}\nswath_deg: {}\nspacing: {}\ntransmit_beamwidth_deg: {}\nreceive_beamwidth_deg: {}\n"
      "sample_rate_hz: {}\nsource_level_db: {}\nauto_range: {}\nrange_m: {}\nquality: 0.05\n",
      draw.scale(50e3, 1e6), draw.whole(2, 100), draw.between(1, 170), spacings[draw.whole(0, 2)], draw.scale(0.5, 20),
      draw.scale(0.5, 20), draw.between(2.0, 4.0) * pulse.band_hz, draw.between(-300, 250), draw.yes(),
      draw.scale(1, 40));
  yaml += pulse.yaml + lod_yaml(draw);
  yaml += fmt::format(
      "detections_per_beam: {}\nback_loss_db: {}\nconverter:\n  bits: {}\nphase_every: {}\nsnippets: {}\n"
      "seabed_image:\n  published: true\nleast_range_m: {}\n",
      draw.yes() ? 1 : draw.whole(2, 8), draw.between(0, 100), draw.yes() ? 0 : draw.whole(1, 16), draw.whole(0, 2),
      draw.yes(), draw.between(0, 4));
  if (draw.yes()) {
    yaml += "sectors:\n";
    for (int i = draw.whole(1, 4); i > 0; --i) {
      yaml += fmt::format("  - {{ share: {}, frequency_hz: {}, tilt_deg: {}, delay_s: {} }}\n", draw.scale(0.05, 20),
                          draw.scale(50e3, 1e6), draw.between(-20, 20), draw.between(0, 0.01));
    }
  }
  return yaml + shading_yaml(draw, "transmit_shading") + shading_yaml(draw, "receive_shading") + effects_yaml(draw);
}

std::string sidescan_yaml(Draws& draw) {
  const char* const focuses[] = {"echo", "off", "fixed\n    focus_m: 10"};
  const std::string line =
      draw.yes() ? shading_yaml(draw, "shading") : fmt::format("focus: {}\n", focuses[draw.whole(0, 2)]);
  std::string yaml = fmt::format(
      "channels:\n  - name: main\n    frequency_hz: {}\n    horizontal_beamwidth_deg: {}\n"
      "    vertical_beamwidth_deg: {}\n    depression_deg: {}\n    back_loss_db: {}\n    source_level_db: {}\n"
      "    range_m: {}\n    samples_per_pulse: {}\n    {}",
      draw.scale(50e3, 1e6), draw.scale(0.05, 10), draw.between(5, 150), draw.between(0, 90), draw.between(0, 100),
      draw.between(-300, 250), draw.scale(1, 40), draw.between(2, 6), line);
  yaml += random_pulse(draw, "    ").yaml;
  yaml += fmt::format("converter:\n  bits: {}\nquality: 0.1\n", draw.yes() ? 0 : draw.whole(1, 16));
  return yaml + lod_yaml(draw) + effects_yaml(draw);
}

std::string forward_looking_yaml(Draws& draw) {
  return fmt::format(
             "frequency_hz: {}\nbeams: {}\naperture_deg: {}\nbeamwidth_deg: {}\ntransmit_vertical_deg: {}\n"
             "receive_vertical_deg: {}\ntilt_deg: {}\nsamples_per_pulse: {}\nmost_samples: {}\n"
             "source_level_db: {}\nrange_m: {}\nconverter:\n  bits: {}\nquality: 0.05\n",
             draw.scale(50e3, 3e6), draw.whole(16, 64), draw.between(10, 160), draw.scale(1, 10), draw.scale(1, 90),
             draw.scale(1, 90), draw.between(-90, 90), draw.between(2, 20), draw.whole(64, 300),
             draw.between(-300, 250), draw.scale(0.5, 40), draw.yes() ? 0 : draw.whole(1, 16)) +
         random_pulse(draw, "").yaml + shading_yaml(draw, "shading") + lod_yaml(draw) + effects_yaml(draw);
}

std::string scanning_yaml(Draws& draw) {
  return fmt::format(
             "frequency_hz: {}\nhorizontal_beamwidth_deg: {}\nvertical_beamwidth_deg: {}\ntilt_deg: {}\n"
             "sector_centre_deg: {}\npulse_length_s: {}\nmost_samples: {}\nsource_level_db: {}\nrange_m: {}\n"
             "converter:\n  bits: {}\nquality: 0.05\n",
             draw.scale(50e3, 3e6), draw.scale(0.5, 20), draw.scale(0.5, 90), draw.between(-90, 90),
             draw.between(-180, 180), draw.scale(2e-5, 1e-3), draw.whole(64, 300), draw.between(-300, 250),
             draw.scale(0.5, 40), draw.yes() ? 0 : draw.whole(1, 16)) +
         shading_yaml(draw, "shading") + effects_yaml(draw);
}

std::string echosounder_yaml(Draws& draw) {
  return fmt::format(
             "frequency_hz: {}\nface: {}\nbeamwidth_deg: {}\nsource_level_db: {}\npulse_length_s: {}\nrange_m: {}\n"
             "samples_per_pulse: {}\nleast_range_m: {}\nconverter:\n  bits: {}\n",
             draw.scale(20e3, 1e6), draw.yes() ? "circular" : "square", draw.scale(0.5, 40), draw.between(-300, 250),
             draw.scale(2e-5, 1e-3), draw.scale(1, 40), draw.between(2, 20), draw.between(1, 4),
             draw.yes() ? 0 : draw.whole(1, 16)) +
         effects_yaml(draw);
}

World random_world(Draws& draw) {
  World world = world_with("head");
  Water& water = world.water;
  water.temperature_degc = draw.between(-2, 30);
  water.salinity_psu = draw.between(0, 40);
  water.wind_speed_mps = draw.yes() ? 0.0 : draw.between(0, 20);
  if (draw.yes()) {
    water.profile.samples = {{0.0, draw.between(1450, 1540), {}, {}},
                             {draw.between(1, 8), draw.between(1450, 1540), {}, {}},
                             {draw.between(9, 30), draw.between(1450, 1540), {}, {}}};
  }
  if (draw.yes()) water.scattering_layers = {{draw.between(0, 5), draw.between(6, 30), draw.between(-90, -40)}};
  if (draw.yes()) water.bubble_loss_db = draw.between(0, 20);
  const auto sediments = seabed::named_sediments();
  world.seabed.sediments = {{0, sediments[static_cast<std::size_t>(draw.whole(0, 13))].parameters},
                            {1, seabed::Lambert{draw.between(-40, -5)}},
                            {2, *seabed::material_of("rigid")}};
  return world;
}

constexpr double kTile_m = 32.0, kPosts_m = 0.5;

/// Waves, steps, boxes with sheer walls, holes, three classes.
msg::Tile random_seabed(Draws& draw) {
  const double depth = draw.between(5, 15), swell = draw.between(0, 2), length = draw.between(2, 20);
  const double box_m = draw.between(0, 6), every = draw.between(3, 12), hole = draw.yes() ? draw.between(0, 8) : 0.0;
  msg::Tile tile = tile_of(kTile_m, kPosts_m, [&](double east, double north) {
    if (std::hypot(east - 6.0, north + 5.0) < hole) return std::nan("");
    const bool box = std::fmod(std::abs(east), every) < 1.5 && std::fmod(std::abs(north), every) < 1.5;
    return -depth + swell * std::sin(6.28 * (east + 0.3 * north) / length) + (box ? box_m : 0.0);
  });
  for (std::size_t i = 0; i < tile.sediment.size(); ++i) tile.sediment.flat()[i] = static_cast<std::uint8_t>(i / 7 % 4);
  return tile;
}

/// Anywhere and anyhow; in turn above the water, on a post to the bit, half a millimetre above one, inside a box, below
/// everything, at the tile's edge.
Course random_course(Draws& draw, const msg::Tile& tile, int number) {
  Course course;
  const auto post = static_cast<std::size_t>(draw.whole(0, 64)), row = static_cast<std::size_t>(draw.whole(0, 64));
  const double height = tile.height_m(row, post);
  const frames::Vec3 on_post(-0.5 * kTile_m + kPosts_m * double(post), -0.5 * kTile_m + kPosts_m * double(row),
                             std::isnan(height) ? -9.0 : height);
  course.start_enu_m = {draw.between(-12, 12), draw.between(-12, 12), draw.between(-8, 0)};
  switch (number % 8) {
    case 0: course.start_enu_m.z() = draw.between(0, 4); break;
    case 1: course.start_enu_m = on_post; break;
    case 2: course.start_enu_m = on_post + frames::Vec3(0, 0, 5e-4); break;
    case 3: course.start_enu_m = on_post - frames::Vec3(0, 0, 0.7); break;
    case 4: course.start_enu_m.z() = -40.0; break;
    case 5: course.start_enu_m.x() = 0.5 * kTile_m; break;
    default: break;
  }
  if (draw.yes()) course.velocity_enu_mps = {draw.between(-10, 10), draw.between(-10, 10), draw.between(-1, 1)};
  if (draw.yes()) {
    course.enu_from_body = frames::enu_from_body({.heading_rad = draw.between(0, 6.28),
                                                  .pitch_rad = draw.between(-1.57, 1.57),
                                                  .roll_rad = draw.between(-3, 3)});
  }
  return course;
}

/// What a head publishes in the time of two pings.
struct Run {
  std::vector<msg::Ping> pings;
  std::vector<msg::Soundings> soundings;
  std::vector<msg::SeabedImage> images;
  std::vector<msg::Health> health;
};

template <class Node>
Run run(const std::string& yaml, Draws& draw, int number) {
  const World world = random_world(draw);
  const msg::Tile tile = random_seabed(draw);
  const Course course = random_course(draw, tile, number);
  NodeUnderTest<Node> head(config_of<Node>(yaml, world, "head"));
  give_course(head, course, 300_ms);
  head.give("tile", tile);
  head.run_until(300_ms);
  Run run;
  run.pings = head.template step_until<msg::Ping>(std::is_same_v<Node, SidescanNode> ? "ping_main" : "ping", 300_ms);
  run.soundings = head.template step_until<msg::Soundings>("soundings", 300_ms);
  run.images = head.template step_until<msg::SeabedImage>("seabed_image", 300_ms);
  run.health = head.template step_until<msg::Health>("health", 300_ms);
  return run;
}

int check_finite(const Run& run) {
  for (const msg::Ping& ping : run.pings) {
    for (const float a : ping.amplitude_upa.flat()) REQUIRE(std::isfinite(a));
    for (const float angle : ping.beam_angle_rad.flat()) REQUIRE(std::isfinite(angle));
    for (const float phase : ping.phase_rad.flat()) REQUIRE(std::isfinite(phase));
    CHECK(ping.amplitude_upa.size() + ping.amplitude_count.size() > 0);
  }
  for (const msg::Soundings& s : run.soundings) {
    for (std::size_t i = 0; i < s.valid.size(); ++i) {
      if (s.valid[i] == 0) continue;
      REQUIRE(std::isfinite(s.travel_time_s[i]));
      for (const auto* values : {&s.backscatter_db, &s.backscatter_strength_db, &s.quality_db, &s.range_sd_m,
                                 &s.angle_sd_rad, &s.window_s}) {
        if (values->size() > 0) REQUIRE(std::isfinite((*values)[i]));
      }
      for (std::size_t axis = 0; axis < 3; ++axis) REQUIRE(std::isfinite(s.position_enu_m(i, axis)));
    }
  }
  for (const msg::SeabedImage& image : run.images) {
    for (const float strength : image.strength_db.flat()) REQUIRE(std::isfinite(strength));
  }
  REQUIRE_FALSE(run.health.empty());
  return static_cast<int>(run.pings.size());
}

constexpr int kCases = 24;

/// Of `kCases` random heads of a kind: how many pings they made.
template <class Node>
int all_finite(const std::function<std::string(Draws&)>& yaml_of) {
  int pings = 0;
  for (int number = 0; number < kCases; ++number) {
    Draws draw(static_cast<std::uint64_t>(number));
    const std::string yaml = yaml_of(draw);
    INFO("case " << number << "\n" << yaml);
    pings += check_finite(run<Node>(yaml, draw, number));
  }
  return pings;
}

}  // namespace

// Half of the cases, or more, must have something to say for the check to mean anything: some have no tile below.
TEST_CASE("no multibeam makes a number that is none") { CHECK(all_finite<MultibeamNode>(multibeam_yaml) > kCases); }
TEST_CASE("no sidescan makes a number that is none") { CHECK(all_finite<SidescanNode>(sidescan_yaml) > kCases); }
TEST_CASE("no forward-looking head makes a number that is none") {
  CHECK(all_finite<ForwardLookingNode>(forward_looking_yaml) > kCases);
}
TEST_CASE("no scanning head makes a number that is none") { CHECK(all_finite<ScanningNode>(scanning_yaml) > kCases); }
TEST_CASE("no echosounder makes a number that is none") {
  CHECK(all_finite<EchosounderNode>(echosounder_yaml) > kCases);
}

namespace {

template <class M>
bool same_bits(const M& a, const M& b) {
  const msg::Body one = msg::encode(a), two = msg::encode(b);
  return msg::same_bytes(one.map, two.map) && std::ranges::equal(one.arrays, two.arrays, msg::same_bytes);
}

/// The same random head with one thread and with two.
template <class Node>
void check_threads(const std::function<std::string(Draws&)>& yaml_of) {
  for (const int number : {6, 7, 14}) {  // heads in the water
    const auto with = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      Draws draw(static_cast<std::uint64_t>(number));
      const std::string yaml = yaml_of(draw);
      return run<Node>(yaml, draw, number);
    };
    const Run one = with(1), two = with(2);
    INFO("case " << number);
    REQUIRE(one.pings.size() == two.pings.size());
    for (std::size_t i = 0; i < one.pings.size(); ++i) CHECK(same_bits(one.pings[i], two.pings[i]));
    REQUIRE(one.soundings.size() == two.soundings.size());
    for (std::size_t i = 0; i < one.soundings.size(); ++i) CHECK(same_bits(one.soundings[i], two.soundings[i]));
  }
}

}  // namespace

TEST_CASE("every head makes the same bits with one thread and with two") {
  check_threads<MultibeamNode>(multibeam_yaml);
  check_threads<SidescanNode>(sidescan_yaml);
  check_threads<ForwardLookingNode>(forward_looking_yaml);
  check_threads<ScanningNode>(scanning_yaml);
  check_threads<EchosounderNode>(echosounder_yaml);
}
