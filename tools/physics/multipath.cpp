#include "kernels/acoustics/echo/multipath.h"

#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct Inputs {
  echo::MultipathHead head{220.0, {}, 15.0};
  echo::SurfaceMirror surface;
  double frequency_hz = 300e3, absorption_dbpm = 0.05, cross_section_db = -40.0;
  double head_depth_m = 5.0, altitude_m = 20.0, ground_range_m = 20.0;
};

/// Time and level of echoes that come by one path, as one: -inf dB of none.
std::vector<double> together(const echo::Arrivals& echoes) {
  if (echoes.empty()) return {std::numeric_limits<double>::quiet_NaN(), db(0.0)};
  std::complex<double> sum;
  for (std::size_t i = 0; i < echoes.size(); ++i) sum += std::complex<double>(echoes[i].pressure_upa);
  return {echoes[0].time_s, db(std::norm(sum))};
}

Verb::Row echoes_of(const Inputs& in) {
  const frames::HeadPose pose{{0.0, 0.0, -in.head_depth_m}, frames::enu_from_ned()};
  echo::Receivers receivers;
  receivers.set({0, 1, std::span(&pose, 1)});
  const double cross_section_m2 = std::pow(10.0, 0.1 * in.cross_section_db);
  const double range2_m2 = in.ground_range_m * in.ground_range_m + in.altitude_m * in.altitude_m;
  echo::Scatterer one;
  one.position_enu_m = {in.ground_range_m, 0.0, -in.head_depth_m - in.altitude_m};
  one.slowness_spm = static_cast<float>(1.0 / in.surface.sound_speed_mps);
  one.cross_section_m2 = static_cast<float>(cross_section_m2);
  one.scattered_upa2m2 =
      static_cast<float>(cross_section_m2 * std::pow(10.0, 0.1 * in.head.source_level_db) / range2_m2);
  one.response = {1.0F, 0.0F};
  const echo::Carrier carrier{in.frequency_hz, in.absorption_dbpm};

  const array::Pattern all_around;
  echo::MultipathHead head = in.head;
  head.transmit = {&all_around, 1};

  echo::Arrivals direct;
  echo::add_direct_echoes(carrier, pose.position_enu_m, {one}, receivers, direct);
  Verb::Row row = together(direct);
  using Parts = echo::MultipathParts;
  for (const Parts& parts : {Parts{true, false, false}, Parts{false, true, false}, Parts{false, false, true}}) {
    echo::Arrivals echoes;
    echo::add_multipath(carrier, head, in.surface, parts, pose, {one}, receivers, echoes);
    for (const double value : together(echoes)) row.push_back(value);
  }
  return row;
}

}  // namespace

void add_multipath(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(
      app, "multipath", "echoes of a small target on the bottom by way of the sea surface; the head sends all around");
  const auto in = std::make_shared<Inputs>();
  verb.number("ground_range_m", in->ground_range_m, 0, 1e5, "horizontal distance of the target");
  verb.number("head_depth_m", in->head_depth_m, 0.01, 12000, "depth of the head");
  verb.number("altitude_m", in->altitude_m, 0.1, 12000, "of the head above the bottom");
  verb.number("frequency_hz", in->frequency_hz, 1e3, 2e6, "of the pulse");
  verb.number("source_level_db", in->head.source_level_db, 0, 260, "rms during the pulse, dB re 1 uPa at 1 m");
  verb.number("target_strength_db", in->cross_section_db, -120, 60, "of the target, in all directions");
  verb.number("absorption_dbpm", in->absorption_dbpm, 0, 2, "absorption");
  verb.number("sound_speed_mps", in->surface.sound_speed_mps, 1300, 1700, "sound speed, the same at all depths");
  verb.number("bottom_loss_db", in->head.bottom_mirror_loss_db, 0, 100, "of a mirror's bounce off the bottom");
  verb.number("surface_loss_db", in->surface.bounce_loss_db, 0, 100, "of each bounce off the surface, by bubbles");
  verb.number("surface_rms_m", in->surface.rms_height_m, 0, 20, "rms height of the waves");
  verb.results({"direct_s", "direct_db", "one_bounce_s", "one_bounce_db", "second_bottom_s", "second_bottom_db",
                "surface_s", "surface_db"},
               [in] { return echoes_of(*in); });
}

}  // namespace ensonify::physics
