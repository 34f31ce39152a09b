#pragma once

#include <cstdint>
#include <string>

#include "messages/array.h"

namespace ensonify::msg {

struct Actuators {
  static constexpr const char* kType = "actuators/1";
  static constexpr const char* kAbout =
      "What a pilot orders of the propellers and fins of a vehicle that is moved by forces, past its own helm.";
  std::int64_t stamp_ns = 0;
  Array<double> propeller_rps;
  Array<double> fin_rad;
  std::string vehicle;
  bool hand_back = false;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the order, sim time", self.stamp_ns);
    visit("propeller_rps", "rev/s", "revolutions of each propeller, ahead positive, in the order of the dynamics file",
          self.propeller_rps);
    visit("fin_rad", "rad", "angle of each fin, positive as the dynamics file has its lift, in its order",
          self.fin_rad);
    visit("vehicle", "", "name of the vehicle that is meant; empty: whichever receives it", self.vehicle);
    visit("hand_back", "1", "release of the vehicle to the next of those who may steer it", self.hand_back);
  }
};

}  // namespace ensonify::msg
