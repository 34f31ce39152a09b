#pragma once

namespace ensonify::logger {

/// Samples of sidescan channels.
enum class XtfSamples { k16Bit, k8Bit, kFloat };

}  // namespace ensonify::logger
