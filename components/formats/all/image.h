#pragma once

#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

#include "components/formats/layout.h"

namespace ensonify::formats::all {

/// Backscattering strength along the swath: "seabed image 89".
struct SeabedImage {
  static constexpr std::string_view kTypes = "Y";
  struct Beam {
    std::int8_t direction = 0;  // of its samples: 1 lowest range first, -1 highest first
    std::uint8_t detection = 0;
    std::uint16_t samples = 0;
    std::uint16_t centre_sample = 0;  // that of the detection, counted from 1

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.direction, self.detection, self.samples, self.centre_sample);
    }
    bool operator==(const Beam&) const = default;
  };
  float sampling_hz = 0;
  std::uint16_t normal_incidence_samples = 0;                 // range at normal incidence, that TVG was corrected with
  FixedPoint<std::int16_t, 10> normal_incidence_strength_db;  // BSN
  FixedPoint<std::int16_t, 10> oblique_strength_db;           // BSO
  FixedPoint<std::uint16_t, 10> transmit_width_deg;
  FixedPoint<std::uint16_t, 10> crossover_deg;
  std::vector<Beam> beams;
  std::vector<std::int16_t> strength_ddb;  // tenths of a decibel, of one beam after the other

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.sampling_hz, self.normal_incidence_samples, self.normal_incidence_strength_db, self.oblique_strength_db,
         self.transmit_width_deg, self.crossover_deg);
    wire.count(kU16, self.beams);
    wire.each(self.beams);
    wire.resize(self.strength_ddb, samples(self.beams));
    wire.each(self.strength_ddb);
  }
  bool operator==(const SeabedImage&) const = default;

  static std::uint64_t samples(const std::vector<Beam>& beams) {
    return std::accumulate(beams.begin(), beams.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const Beam& beam) { return sum + beam.samples; });
  }
};

}  // namespace ensonify::formats::all
