#pragma once

#include <deque>
#include <vector>

#include "components/runtime/ports.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/other_heads.h"
#include "kernels/acoustics/echo/interference.h"
#include "messages/sonar.h"

namespace ensonify {

/// Transmissions of the vehicle's other heads during reception. With heads to receive it has the input `transmits`,
/// delayed: heads may receive each other, and what was sent up to the last echo has arrived when the ping is computed.
class Interference {
 public:
  /// `latency` is that from the last echo to the computation.
  Interference(Ports& ports, const HeadInputs& inputs, const std::vector<OtherHead>& others, SimTime latency);
  Interference(const Interference&) = delete;
  Interference& operator=(const Interference&) = delete;

  /// Transmissions that may be received by a ping that left at `transmit` and receives for `reception`: straight, and
  /// by the mirror of a level seabed, as deep everywhere as below the head. By the true poses of the vehicle.
  std::vector<echo::InterferingTransmission> during(SimTime transmit, SimTime reception) const;

 private:
  struct Received {
    const OtherHead* from;
    msg::Transmit sent;
  };

  const HeadInputs& inputs_;
  std::vector<OtherHead> others_;
  std::deque<Received> received_;
};

}  // namespace ensonify
