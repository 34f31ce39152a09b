#pragma once

#include <vector>

#include "components/navigation/estimator.h"
#include "components/runtime/ports.h"
#include "messages/navigation.h"

namespace ensonify {

/// Fixes of this vehicle's transponder by another's array, as they come over telemetry: late, and with all that the
/// other vehicle errs by.
class UsblFixes {
 public:
  UsblFixes(const UsblFixesConfig& config, Ports& ports);

  /// Corrects with what has come since the last time.
  void correct(Estimator& estimator, const frames::LocalProjection& world);

 private:
  Estimator::Filter::Fix fix_of(const msg::UsblFix& found, const Estimator& estimator,
                                const frames::LocalProjection& world) const;

  UsblFixesConfig config_;
  std::vector<msg::UsblFix> come_;
};

}  // namespace ensonify
