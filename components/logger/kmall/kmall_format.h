#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/formats/kmall/writer.h"
#include "components/logger/format.h"

namespace ensonify::logger {

/// Kongsberg .kmall, revision I, EM 2040: #IIP, #IOP, #SVP; then #SKM, #SPO, #CPO, #SCL and #SVT as they are due, #MRZ
/// of each ping. A .kmwcd has #SPO, and #CHE and #MWC of pings with a water column, in place of those after #SVP.
class KmallFormat : public Format {
 public:
  /// `mark` says that files are simulated.
  KmallFormat(const LoggerConfig& config, std::string mark, Part part);

  std::string ending() const override { return part_ == Part::kSoundings ? ".kmall" : ".kmwcd"; }
  void begin(const FileStart& start, formats::Bytes& out) override;
  void moment(const Moment& moment, formats::Bytes& out) override;
  void ping(const LoggedSoundings& ping, formats::Bytes& out) override;
  using Format::ping;
  void end(formats::Bytes& out) override { finish_motion(out); }

 private:
  void finish_motion(formats::Bytes& out);

  bool simulator() const { return config_.mark_simulated == SimulatedMarks::kDatagrams; }

  LoggerConfig config_;
  std::string mark_;
  Part part_;
  formats::kmall::Writer writer_;
  std::vector<Moment> motion_;    // of the second that is not over
  std::optional<Moment> before_;  // it
  double height_m_ = 0.0;         // of the last moment
  double sound_speed_mps_ = 0.0;
  std::optional<formats::kmall::Runtime> runtime_;  // as last written
};

}  // namespace ensonify::logger
