// The numbers of pictures in docs/physics that take the fixtures of tests, as CSV (docs/physics/draw).
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "kernels/acoustics/detect/testing/accuracy.h"
#include "kernels/acoustics/echo/testing/flat_seabed.h"
#include "kernels/acoustics/echo/testing/strip.h"
#include "kernels/acoustics/trace/testing/boulders.h"
#include "tests/physics/multibeam_speckle.h"
#include "tests/physics/sidescan_speckle.h"

namespace ensonify {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

void print_accuracy() {
  std::puts("snr_db,angle_deg,bias,sd,predicted_sd,amplitude_sd,phase_weight,found,expected_sd");
  std::vector<double> angles_deg;
  for (int deg = 0; deg <= 70; deg += deg < 20 ? 2 : 5) angles_deg.push_back(deg);
  for (const double snr_db : {20.0, 10.0}) {
    for (const detect::Accuracy& a : detect::accuracy_at(snr_db, angles_deg, 0.0, 300)) {
      std::printf("%g,%g,%g,%g,%g,%g,%g,%g,%g\n", snr_db, a.angle_rad / kDeg, a.bias, a.sd, a.predicted_sd,
                  a.amplitude_sd, a.phase_weight, a.found, detect::theoretical_sd(a.angle_rad, snr_db));
    }
  }
}

void print_phase_ramps() {
  detect::PlaneSurvey survey;
  for (const double deg : {15, 30, 45, 60}) survey.sin_beams.push_back(static_cast<float>(std::sin(deg * kDeg)));
  detect::PlaneEcho echo;
  echo.ping(survey, {11, "plane"}, 0);
  std::vector<detect::Detection> found;
  detect::detect_bottom(detect::settings_for(survey), survey.sin_beams, echo.amplitudes(survey), echo.halves(), found);
  std::puts("angle_deg,time_s,amplitude_upa,phase_rad,detected_s,true_s");
  const int samples = echo.amplitudes(survey).samples;
  for (std::size_t beam = 0; beam < found.size(); ++beam) {
    const detect::Detection& d = found[beam];
    for (int k = d.snippet_first; k < d.snippet_first + d.snippet_count; ++k) {
      const std::size_t i = beam * static_cast<std::size_t>(samples) + static_cast<std::size_t>(k);
      std::printf("%g,%.9g,%g,%g,%.9g,%.9g\n", std::asin(survey.sin_beams[beam]) / kDeg,
                  k * survey.period_s - 0.5 * survey.pulse_length_s, echo.amplitude_upa[i],
                  std::arg(echo.positive_upa[i] * std::conj(echo.negative_upa[i])), d.two_way_s,
                  detect::two_way_s(survey, survey.sin_beams[beam]));
    }
  }
}

/// Head 0: multibeam, axis is the beam's angle; head 1: sidescan, axis is the slant range.
void print_levels() {
  const auto arrivals = echo::below_a_multibeam(24, 16384);
  std::puts("head,axis,level_db");
  for (int deg = 0; deg <= 66; deg += 3) std::printf("0,%d,%.4f\n", deg, echo::peak_db(arrivals, deg * kDeg, 25e-6));
  const echo::Image image = echo::sidescan_mean_square(array::length_in_waves_for(0.5 * kDeg));
  for (double range_m = 13; range_m < 101; range_m *= 1.04) {
    std::printf("1,%.3f,%.4f\n", range_m, echo::sidescan_level_db(image, range_m));
  }
}

/// Kind 0: coherence of two pings x transmit lengths apart; kind 1: share of amplitudes below x times the rms.
void print_speckle() {
  const frames::Vec3 start(0.3, -0.2, 0.0);
  std::puts("kind,x,y");
  for (int i = 0; i <= 14; ++i) {
    const frames::Vec3 moved(0.0, 0.05 * i * echo::kLines * echo::kWave, 0.0);
    std::printf("0,%.4f,%.5f\n", i * 0.05, echo::coherence(start, start + moved, 40));
  }
  std::vector<double> powers;
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto echo = echo::strip().echo({0, 0, 0}, 5000 + seed);
    for (std::size_t k = 0; k < echo.size(); k += 2) powers.push_back(std::norm(echo[k])), sum += powers.back();
  }
  std::sort(powers.begin(), powers.end());
  const auto n = static_cast<double>(powers.size());
  for (std::size_t i = 0; i < powers.size(); i += 9) {
    std::printf("1,%.5f,%.5f\n", std::sqrt(powers[i] / (sum / n)), (static_cast<double>(i) + 0.5) / n);
  }
}

void print_rays() {
  using namespace trace::sounding;
  const Sounding s = trace_ping(strewn_with_boulders(1, 0.25, 400), {trace::RaySettings::kNormal, 0.075});
  std::puts("sine,across_deg,range_m,east_m,north_m,up_m");
  for (std::size_t k = 0; k < s.hits.size(); ++k) {
    const frames::Vec3 at = s.hits[k].position_enu_m;
    if (!s.hits[k].hit()) continue;
    std::printf("%.5f,%.3f,%.3f,%.3f,%.3f,%.3f\n", static_cast<double>(s.rays[k].direction_head.x()),
                across_rad(s.rays[k]) / kDegree, static_cast<double>(s.hits[k].range_m), at.x(), at.y(), at.z());
  }
}

/// Kind 0: sidescan moved along the track, in lengths of its line; 1: across, m; 2: multibeam along.
void print_decorrelation() {
  namespace sidescan = physics::sidescan_speckle;
  namespace multibeam = physics::multibeam_speckle;
  std::puts("kind,moved,correlation,theory");
  const auto print = [](int kind, double moved, double correlation, double theory) {
    std::printf("%d,%.3f,%.5f,%.5f\n", kind, moved, correlation, theory);
  };
  for (double x = 0.0; x < 1.15; x += 0.1) {
    print(0, x, sidescan::correlation_after({0.0, x * sidescan::line_m(), 0.0}, 3), sidescan::along_track(x));
  }
  for (double x = 0.0; x < 0.085; x += 0.01) {
    print(1, x, sidescan::correlation_after({x, 0.0, 0.0}, 3), sidescan::across_track(x));
  }
  for (double x = 0.0; x < 0.625; x += 0.05) {
    print(2, x, multibeam::correlation_after({0.0, x * multibeam::line_m(), 0.0}, 6), multibeam::along_track(x));
  }
}

int run(const std::string& name) {
  const std::map<std::string, std::function<void()>> experiments{
      {"accuracy", print_accuracy}, {"phase-ramps", print_phase_ramps},
      {"levels", print_levels},     {"speckle", print_speckle},
      {"rays", print_rays},         {"decorrelation", print_decorrelation}};
  const auto chosen = experiments.find(name);
  if (chosen == experiments.end()) {
    std::fputs("experiments: name one of", stderr);
    for (const auto& [known, print] : experiments) std::fprintf(stderr, " %s", known.c_str());
    std::fputs("\n", stderr);
    return 2;
  }
  chosen->second();
  return 0;
}

}  // namespace
}  // namespace ensonify

int main(int argc, char** argv) { return ensonify::run(argc == 2 ? argv[1] : ""); }
