// Writes every sentence of navigation once with given values, for readers that are not ours.   write_sentences
#include <cstdio>
#include <numbers>

#include "components/formats/ais/position_report.h"
#include "components/formats/nmea/writer.h"

int main() {
  using namespace ensonify;
  constexpr double kDegree = std::numbers::pi / 180.0, kKnot_mps = 1852.0 / 3600.0;
  const double time_s = 12 * 3600 + 34 * 60 + 56.789;
  const auto day = std::chrono::sys_days(std::chrono::year(2025) / 6 / 1);
  const formats::Motion motion{time_s, 218.26 * kDegree, -1.25 * kDegree, 2.5 * kDegree, -0.58};
  formats::ais::PositionReport report;
  report.mmsi = 970000001;
  report.status = 0;
  report.turn_rate_radps = -10.0 / 60.0 * kDegree;
  report.speed_mps = 8.4 * kKnot_mps;
  report.accurate = true;
  report.latitude_deg = 54.25;
  report.longitude_deg = -3.125;
  report.course_rad = 217.3 * kDegree;
  report.heading_rad = 218.0 * kDegree;
  report.second = 56;
  for (const std::string& sentence :
       {nmea::gga("GP", {time_s, 4, 54.25, -3.125, 0.8, 12.345, 50.125}),
        nmea::gst("GP", {time_s, 0.012, 0.013, 0.021}), nmea::zda("GP", {time_s, day}),
        nmea::vtg("GP", {217.3 * kDegree, 8.4 * kKnot_mps}), nmea::hdt("HE", {218.26 * kDegree}),
        nmea::rot("TI", {-10.0 / 60.0 * kDegree}), nmea::dpt("SD", {23.45, 1.2}), nmea::dbt("SD", {23.45, {}}),
        nmea::pashr(motion, {0.02 * kDegree, 0.02 * kDegree, 0.05 * kDegree}, 4), nmea::psxn_20({}),
        nmea::psxn_23(motion), formats::ais::vdm(report), formats::ais::vdo(report)}) {
    std::fputs(sentence.c_str(), stdout);
  }
}
