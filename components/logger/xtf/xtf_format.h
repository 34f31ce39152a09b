#pragma once

#include <optional>
#include <string>

#include "components/logger/format.h"
#include "components/logger/xtf/packets.h"
#include "components/logger/xtf/sidescan.h"
#include "messages/declarations.h"

namespace ensonify::logger {

/// Triton XTF: sidescan and multibeam, with raw navigation and attitude; a remark first that it is simulated.
class XtfFormat : public Format {
 public:
  /// Heads that it writes, as they are declared; `mark` says that files are simulated.
  XtfFormat(const LoggerConfig& config, std::string mark, std::optional<msg::HeadDeclaration> sidescan,
            std::optional<msg::HeadDeclaration> multibeam);

  std::string ending() const override { return ".xtf"; }
  void begin(const FileStart& start, formats::Bytes& out) override;
  void moment(const Moment& moment, formats::Bytes& out) override;
  void ping(const LoggedSoundings& ping, formats::Bytes& out) override;
  void ping(const LoggedSidescan& ping, formats::Bytes& out) override;
  void end(formats::Bytes& /*out*/) override {}

 private:
  XtfMoment moment_at(const msg::HeadTrack& track, const Vessel& vessel, std::int64_t unix_ns, double heave_down_m,
                      const frames::LocalProjection& world) const;

  LoggerConfig config_;
  std::string mark_;
  std::optional<msg::HeadDeclaration> sidescan_, multibeam_;
  XtfClock clock_;
  double speed_mps_ = 0.0;  // last known
};

}  // namespace ensonify::logger
