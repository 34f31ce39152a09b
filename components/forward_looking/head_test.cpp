#include "components/forward_looking/head.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/seabed/backscatter.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;
constexpr double kSpeed_mps = 1500.0;
constexpr double kAbsorption_dbpm = 0.2;

/// 10 m under the surface; sound that travels straight, over a Lambert seabed.
ForwardLookingConfig quiet() {
  ForwardLookingConfig config;
  world_of(config).water.profile.sound_speed_mps = kSpeed_mps;
  world_of(config).water.absorption_dbpm = kAbsorption_dbpm;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}};
  config.process = "eye";
  config.effects.noise = config.effects.multipath = false;
  return config;
}

/// 128 m of seabed about the origin.
trace::Scene scene_of(const std::function<double(double, double)>& height_m) {
  trace::Scene scene({0, 0});
  scene.insert({0, 0},
               terrain::sample_tile({.origin_enu_m = {-64, -64}, .spacing_m = 0.25, .cells = 512}, {0, 0}, height_m));
  return scene;
}

/// 10 m deep, pointing north.
frames::PoseHistory at_rest() {
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  return truth;
}

msg::Ping ping_of(const ForwardLookingConfig& config, trace::Scene& scene) {
  ForwardLooking head(config, 0);
  return image_of(head, {0, SimTime{0}, config.range_m}, config.start(), around(at_rest(), scene, kSpeed_mps));
}
msg::Ping ping_of(const ForwardLookingConfig& config, trace::Scene&& scene) { return ping_of(config, scene); }

double range_of(const msg::Ping& ping, std::size_t sample) {
  return 0.5 * kSpeed_mps * (ping.first_sample_s + static_cast<double>(sample) * ping.sample_period_s);
}

/// Mean square over some beams and slant ranges.
double mean_square(const msg::Ping& ping, double from_deg, double to_deg, double from_m, double to_m) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t beam = 0; beam < ping.amplitude_upa.rows(); ++beam) {
    const double angle_deg = static_cast<double>(ping.beam_angle_rad[beam]) / kDeg;
    if (angle_deg < from_deg || angle_deg > to_deg) continue;
    for (std::size_t k = 0; k < ping.amplitude_upa.cols(); ++k) {
      if (range_of(ping, k) < from_m || range_of(ping, k) > to_m) continue;
      const double a = static_cast<double>(ping.amplitude_upa(beam, k));
      sum += a * a;
      ++count;
    }
  }
  return sum / count;
}

double db(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace

TEST_CASE("a sphere's echo has the level of the sonar equation in its beam, at its range") {
  // TS -20 dB at 20 m, 40 degrees to starboard and 6 degrees down, by the kernel's scatterer and the head's faces.
  const ForwardLookingConfig config = quiet();
  const double wavelength_m = kSpeed_mps / config.frequency_hz, R = 20.0, ts_db = -20.0;
  const array::LineArray array = array::line_array_of_width(config.beamwidth_rad, wavelength_m);
  const ForwardFaces faces(config, array.element_length_m / wavelength_m);
  const double azimuth = 40 * kDeg, down = 6 * kDeg;
  const frames::Vec3 direction(std::cos(down) * std::cos(azimuth), std::cos(down) * std::sin(azimuth), std::sin(down));
  const frames::HeadPose pose{};

  echo::Scatterer sphere;
  sphere.position_enu_m = frames::enu_from_head(pose, R * direction);
  sphere.slowness_spm = static_cast<float>(1.0 / kSpeed_mps);
  sphere.scattered_upa2m2 = static_cast<float>(std::pow(10.0, 0.1 * (config.source_level_db + ts_db)) *
                                               faces.transmit.power(direction.cast<float>()) / R / R);
  sphere.response = 1.0F;
  echo::Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&pose, 1)});
  echo::Arrivals arrivals;
  echo::add_direct_echoes({config.frequency_hz, kAbsorption_dbpm}, pose.position_enu_m, {sphere}, receivers, arrivals);
  const std::vector<float> gain{faces.element.amplitude(arrivals[0].direction_head)};

  const RangedPulse ranged = pulse_at(config.pulse, 30.0, kSpeed_mps);
  const echo::SampledPulse pulse(echo_pulse(config.pulse, ranged), ranged.sampling.period_s);
  echo::LineReceiver receiver(echo::element_line(array, wavelength_m));
  const std::vector<echo::WantedImage> wanted{echo::WantedImage(echo::beam_weights(array.weights))};
  const double sin_target = direction.y(), per_lobe = 1.0 / array::length_in_waves_for(config.beamwidth_rad);
  std::vector<float> sines;  // from the target on in hundredths of lambda / L
  for (int i = 0; i < 300; ++i) sines.push_back(static_cast<float>(sin_target - 0.01 * i * per_lobe));
  std::vector<echo::Image> images(1);
  echo::LineReceiver::Memory memory;
  receiver.form({std::array{echo::EchoSet{arrivals, gain}}, pulse, ranged.sampling, {}}, sines, wanted, images, memory);

  const auto on_axis = images[0].row(0);
  std::size_t peak = 0;
  for (std::size_t k = 0; k < on_axis.size(); ++k) peak = std::abs(on_axis[k]) > std::abs(on_axis[peak]) ? k : peak;
  CHECK_THAT(0.5 * kSpeed_mps * static_cast<double>(peak) * ranged.sampling.period_s,
             WithinAbs(R, 0.25 * kSpeed_mps * ranged.sampling.period_s));
  // Patterns in closed form: cos^q with -3 dB at 65 degrees, both lines of 20 degrees, a half-wave element.
  const double across_db =
      20.0 * std::log10(std::cos(std::asin(sin_target))) * (db(0.5) / (20.0 * std::log10(std::cos(65 * kDeg))));
  const double line_db = db(array::line_power(array::length_in_waves_for(20 * kDeg), std::sin(down)));
  const double element_db = db(array::line_power(array.element_length_m / wavelength_m, sin_target));
  const double expected_db = config.source_level_db - 40.0 * std::log10(R) - 2.0 * kAbsorption_dbpm * R + ts_db +
                             across_db + 2.0 * line_db + element_db;
  // A sample may stand half a period off the compressed pulse's peak: 0.4 dB there with two samples per 1 / B.
  const double level_db = db(std::norm(on_axis[peak]));
  CHECK_THAT(level_db, WithinAbs(expected_db, 0.5));

  double side_lobe = 0.0;  // beyond the first null
  for (std::size_t i = 105; i < 200; ++i) {
    side_lobe = std::max(side_lobe, static_cast<double>(std::norm(images[0].row(static_cast<int>(i))[peak])));
  }
  CHECK_THAT(db(side_lobe) - level_db, WithinAbs(-13.26, 0.05));  // uniform line [Lurton2010, ch. 5]
}

TEST_CASE("the mean level of a flat seabed is that of the area integral") {
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  config.range_m = 50.0;
  config.tilt_rad = 10 * kDeg;
  config.beams = 64;
  config.pulse.most_samples = 500;  // 0.1 m
  config.quality = 1.0;
  constexpr double kAltitude_m = 5.0;
  const msg::Ping ping = ping_of(config, scene_of([](double, double) { return -10.0 - kAltitude_m; }));
  const double wavelength_m = kSpeed_mps / config.frequency_hz;
  const array::LineArray array = array::line_array_of_width(config.beamwidth_rad, wavelength_m);
  const double line_in_waves = array::length_in_waves_for(20 * kDeg),
               q = 0.5 * std::log(0.5) / std::log(std::cos(65 * kDeg));
  const RangedPulse ranged = pulse_at(config.pulse, 50.0, kSpeed_mps);
  const double length_m = 0.5 * kSpeed_mps * echo_pulse(config.pulse, ranged).equivalent_length_s();

  for (const double R : {15.0, 25.0, 40.0}) {
    for (const double beam_deg : {-50.0, 0.0, 30.0}) {
      // Integral over azimuth of the ring between R and R + length: dA = R dR dphi.
      double sum = 0.0;
      constexpr int kSteps = 40000;
      for (int i = 0; i < kSteps; ++i) {
        const double phi = -0.5 * kPi + kPi * (i + 0.5) / kSteps, ground = std::sqrt(R * R - kAltitude_m * kAltitude_m);
        const double x = ground / R * std::cos(phi), y = ground / R * std::sin(phi), z = kAltitude_m / R;
        const double up_the_face = z * std::cos(config.tilt_rad) - x * std::sin(config.tilt_rad);
        const double vertical = array::line_power(line_in_waves, up_the_face);
        sum += std::pow(1.0 - y * y, q) * vertical * vertical *
               array::power(array, wavelength_m, y, std::sin(beam_deg * kDeg)) * kPi / kSteps;
      }
      const double expected_db = config.source_level_db - 40.0 * std::log10(R) - 2.0 * kAbsorption_dbpm * R +
                                 db(seabed::lambert_backscatter(-25.0, kAltitude_m / R) * R * length_m * sum);
      // The nearest beam or two, and a metre of range over which the level is near enough linear.
      const double level_db = db(mean_square(ping, beam_deg - 1.1, beam_deg + 1.1, R - 0.5, R + 0.5));
      INFO("range " << R << " m, beam " << beam_deg << " deg");
      CHECK_THAT(level_db, WithinAbs(expected_db, 0.5));
    }
  }
}

TEST_CASE("a tapered tone keeps a flat seabed's mean level but for its effective length") {
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  config.range_m = 30.0;
  config.tilt_rad = 10 * kDeg;
  config.beams = 32;
  config.pulse.chirp = false;
  config.pulse.most_samples = 300;
  trace::Scene scene = scene_of([](double, double) { return -15.0; });
  const msg::Ping rectangular = ping_of(config, scene);
  config.pulse.tapered_fraction = 0.5;
  const msg::Ping tapered = ping_of(config, scene);
  CHECK(rectangular.applied.pulse == "cw");
  CHECK(tapered.applied.pulse == "cw_tapered");
  CHECK(tapered.applied.tapered_fraction == 0.5);
  for (const double R : {10.0, 15.0, 25.0}) {
    const auto level_db = [&](const msg::Ping& ping) { return db(mean_square(ping, -60, 60, R - 1.0, R + 1.0)); };
    // The square of a raised cosine has a mean of 3/8: 1 - 5/8 of the tapered fraction is left.
    CHECK_THAT(level_db(tapered) - level_db(rectangular), WithinAbs(db(1.0 - 5.0 / 16.0), 0.2));
  }
}

TEST_CASE("a block is at its azimuth and range, and its shadow has the length of geometry") {
  // 5 m of altitude. North of the head a wall 1 m high, its top 2 m long.
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  config.range_m = 40.0;
  config.tilt_rad = 10 * kDeg;
  config.beams = 131;
  config.pulse.most_samples = 800;  // every 0.05 m
  config.quality = 1.0;
  for (const double front_m : {17.0, 20.0, 22.75}) {
    const auto wall = [&](double east, double north) {  // to 11 degrees on either side of its far edge
      return std::abs(east) <= 0.2 * (front_m + 2.0) && north >= front_m && north <= front_m + 2.0 ? -14.0 : -15.0;
    };
    const msg::Ping ping = ping_of(config, scene_of(wall));
    // From over the top's far edge, 4 m below the head, to the seabed 5 m below it.
    const double far_edge_m = front_m + 2.0;
    const double begins_m = std::hypot(far_edge_m, 4.0), ends_m = std::hypot(far_edge_m * 5.0 / 4.0, 5.0);
    const double beyond = mean_square(ping, -2, 2, ends_m + 0.3, ends_m + 1.3);
    // Side lobes of the seabed to either side, beyond 11 degrees, stay: 1 / (pi^2 11) of its level, -20 dB.
    CHECK(db(mean_square(ping, -2, 2, begins_m + 0.3, ends_m - 0.3) / beyond) < -16.0);
    const double top = mean_square(ping, -2, 2, begins_m - 1.0, begins_m - 0.3);
    CHECK(top > beyond);

    // An edge is where the level falls to half, between samples: the compressed pulse is as long before its middle as
    // after. The first sample beyond it alone would be late by anything up to a step.
    const double step_m = 0.5 * kSpeed_mps * ping.sample_period_s;
    const auto edge_m = [&](double level, int towards) {
      const auto from = static_cast<std::ptrdiff_t>(std::round(0.5 * (begins_m + ends_m) / step_m));
      const auto square = [&](std::ptrdiff_t k) {
        const double at_m = range_of(ping, static_cast<std::size_t>(k));
        return mean_square(ping, -2, 2, at_m - 0.1 * step_m, at_m + 0.1 * step_m);
      };
      std::ptrdiff_t k = from;
      while (square(k) < 0.5 * level) k += towards;
      const double inside = square(k - towards), outside = square(k);
      return range_of(ping, static_cast<std::size_t>(k)) -
             towards * step_m * (outside - 0.5 * level) / (outside - inside);
    };
    const double from_m = edge_m(top, -1), to_m = edge_m(beyond, 1);
    INFO("wall at " << front_m << " m: shadow from " << from_m << " to " << to_m << " m, by geometry from " << begins_m
                    << " to " << ends_m << " m");
    CHECK_THAT(to_m, WithinAbs(ends_m, step_m));
    CHECK_THAT(from_m, WithinAbs(begins_m, step_m));
    CHECK_THAT(to_m - from_m, WithinAbs(ends_m - begins_m, step_m));
  }
}

TEST_CASE("a pillar is brightest in the beam and at the range where it stands") {
  // 0.5 m thick, 1.5 m high; 30 degrees to starboard (east), 20 m away.
  const double east_m = 20.0 * std::sin(30 * kDeg), north_m = 20.0 * std::cos(30 * kDeg);
  const auto pillar = [&](double east, double north) {
    return std::hypot(east - east_m, north - north_m) < 0.3 ? -13.5 : -15.0;
  };
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  config.tilt_rad = 10 * kDeg;
  config.range_m = 30.0;
  const msg::Ping ping = ping_of(config, scene_of(pillar));
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < ping.amplitude_upa.size(); ++i) {
    // The seabed grows darker with range as R^-5 or so: what stands out, stands out of that.
    const auto out = [&](std::size_t at) {
      const double R = range_of(ping, at % ping.amplitude_upa.cols());
      return R < 10.0 ? 0.0 : static_cast<double>(ping.amplitude_upa.flat()[at]) * R * R * R;
    };
    if (out(i) > out(brightest)) brightest = i;
  }
  const double found_deg = static_cast<double>(ping.beam_angle_rad[brightest / ping.amplitude_upa.cols()]) / kDeg;
  CHECK_THAT(found_deg, WithinAbs(30.0, 1.6));  // 0.55 m to either side with its slopes: half its width
  const double front_m = 20.0 - 0.3 - 0.25, range_m = range_of(ping, brightest % ping.amplitude_upa.cols());
  CHECK(range_m > std::hypot(front_m, 3.5) - 0.1);  // from the front's top ...
  CHECK(range_m < std::hypot(20.0, 5.0) + 0.1);     // ... to its foot
}

TEST_CASE("one effect switched off leaves the draws of the others alone") {
  // Each random part alone in the image, the speckle of a seabed and what an empty sea sounds like: it must stay the
  // same bits whatever else is switched off. What it is received through (faces, weights, for echoes the water's loss)
  // is no draw.
  struct Part {
    const char* name;
    bool Effects::*of;
    bool seabed;
    std::vector<bool Effects::*> received_through;
  };
  const std::vector<Part> parts{
      {"speckle", &Effects::speckle, true, {&Effects::directivity, &Effects::side_lobes, &Effects::absorption}},
      {"noise", &Effects::noise, false, {&Effects::directivity, &Effects::side_lobes}},
      {"volume", &Effects::volume, false, {&Effects::directivity, &Effects::side_lobes, &Effects::absorption}}};
  const std::pair<const char*, bool Effects::*> switches[] = {{"refraction", &Effects::refraction},
                                                              {"absorption", &Effects::absorption},
                                                              {"directivity", &Effects::directivity},
                                                              {"side_lobes", &Effects::side_lobes},
                                                              {"speckle", &Effects::speckle},
                                                              {"noise", &Effects::noise},
                                                              {"volume", &Effects::volume},
                                                              {"multipath", &Effects::multipath},
                                                              {"interference", &Effects::interference},
                                                              {"motion", &Effects::motion},
                                                              {"tvg", &Effects::tvg},
                                                              {"quantisation", &Effects::quantisation}};
  ForwardLookingConfig config = quiet();
  world_of(config).water.scattering_layers = {{0.0, 100.0, -60.0}};
  config.tilt_rad = 10 * kDeg;
  config.beams = 32;
  config.pulse.most_samples = 200;
  config.quality = 0.1;
  constexpr double kBeforeSurface_m = 8.0;  // whose own echo comes from 10 m, and takes part in what is switched off
  for (const Part& part : parts) {
    trace::Scene scene = part.seabed ? scene_of([](double, double) { return -15.0; }) : trace::Scene({0, 0});
    Effects on;
    on.noise = on.volume = false;
    on.*part.of = true;
    const auto image = [&](const Effects& effects, std::uint64_t seed) {
      config.effects = effects;
      world_of(config).seed = seed;
      const msg::Ping ping = ping_of(config, scene);
      std::vector<float> before;
      for (std::size_t i = 0; i < ping.amplitude_upa.size(); ++i) {
        const bool early = range_of(ping, i % ping.amplitude_upa.cols()) < kBeforeSurface_m;
        if (early) before.push_back(ping.amplitude_upa.flat()[i]);
      }
      return before;
    };
    const auto whole = image(on, 1);
    CHECK(*std::max_element(whole.begin(), whole.end()) > 0.0F);
    CHECK_FALSE(image(on, 2) == whole);  // it is drawn at all
    for (const auto& [name, off] : switches) {
      INFO(part.name << " without " << name);
      Effects without = on;
      without.*off = false;
      const bool its_own =
          off == part.of || std::count(part.received_through.begin(), part.received_through.end(), off) > 0;
      CHECK((image(without, 1) == whole) != its_own);
    }
  }
}

namespace {

/// Of what is received from one side only: few beams, no speckle.
ForwardLookingConfig of_one_side() {
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  config.tilt_rad = 10 * kDeg;
  config.range_m = 40.0;
  config.beams = 64;
  config.pulse.most_samples = 300;
  return config;
}

trace::Scene seabed_to_starboard() {
  return scene_of([](double east, double) { return east > -3.0 ? -15.0 : -60.0; });
}

}  // namespace

TEST_CASE("a shaded array of equal beamwidth is longer, and has lower side lobes") {
  ForwardLookingConfig config = of_one_side();
  trace::Scene scene = seabed_to_starboard();
  const msg::Ping uniform = ping_of(config, scene);
  const double uniform_near_m = near_field_m(config);
  config.shading = {array::Shading::Window::kTaylor, 30.0, 4};
  const msg::Ping shaded = ping_of(config, scene);
  // Half-power widths are 64.4 and 50.76 lambda / L degrees.
  CHECK(near_field_m(config) / uniform_near_m == Approx(std::pow(64.4 / 50.76, 2)).epsilon(0.01));
  CHECK(mean_square(shaded, -60, -40, 20, 30) < 0.1 * mean_square(uniform, -60, -40, 20, 30));
  CHECK_THAT(db(mean_square(shaded, 20, 40, 20, 30) / mean_square(uniform, 20, 40, 20, 30)), WithinAbs(0.0, 0.5));
}

TEST_CASE("no directivity raises outer beams; no side lobes empty a wall's far side") {
  ForwardLookingConfig config = of_one_side();
  trace::Scene scene = seabed_to_starboard();
  const msg::Ping full = ping_of(config, scene);
  config.effects.side_lobes = false;
  const msg::Ping shaded = ping_of(config, scene);
  CHECK(mean_square(shaded, -60, -40, 20, 30) < 0.1 * mean_square(full, -60, -40, 20, 30));
  CHECK(mean_square(shaded, 20, 40, 20, 30) > 0.5 * mean_square(full, 20, 40, 20, 30));
  config.effects.side_lobes = true;
  config.effects.directivity = false;
  const msg::Ping open = ping_of(config, scene);
  // At 55 degrees: cos^q takes 2.1 dB, a half-wave element 2.6 dB; elevation takes some more.
  const double gain_db = db(mean_square(open, 50, 60, 20, 30) / mean_square(full, 50, 60, 20, 30));
  CHECK(gain_db > 4.0);
  CHECK(gain_db < 9.0);
}

TEST_CASE("a wrong sound speed at the face turns the beams as it scales their sines") {
  const double east_m = 20.0 * std::sin(50 * kDeg), north_m = 20.0 * std::cos(50 * kDeg);
  const auto pillar = [&](double east, double north) {
    return std::hypot(east - east_m, north - north_m) < 0.3 ? -12.0 : -60.0;
  };
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  config.range_m = 30.0;
  config.pulse.most_samples = 300;
  ForwardLooking head(config, 0);
  trace::Scene scene = scene_of(pillar);
  const auto seen_deg = [&](double known_mps) {
    const msg::Ping ping = image_of(head, {0, SimTime{0}, 30.0}, config.start(), around(at_rest(), scene, known_mps));
    const auto all = ping.amplitude_upa.flat();
    const auto at = static_cast<std::size_t>(std::max_element(all.begin(), all.end()) - all.begin());
    return static_cast<double>(ping.beam_angle_rad[at / ping.amplitude_upa.cols()]) / kDeg;
  };
  // The pillar is 1.7 degrees wide, and its brightest spot anywhere on it.
  CHECK_THAT(seen_deg(1500.0), WithinAbs(50.0, 0.9));
  // sin(beam) 1500 / 1440 = sin(50): 47.3 degrees, two and a half beams off.
  CHECK_THAT(seen_deg(1440.0), WithinAbs(std::asin(std::sin(50 * kDeg) * 0.96) / kDeg, 0.9));
}
