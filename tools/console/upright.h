#pragma once

#include "messages/view.h"

namespace ensonify::console {

/// A fan with the head's roll taken out: angles of beams and detections count from the vertical instead of from the
/// head's axis. As it is where the head looks forward, or its attitude is not known.
msg::View upright(msg::View view);

}  // namespace ensonify::console
