#pragma once

#include <optional>
#include <string>

#include "components/formats/all/writer.h"
#include "components/logger/format.h"

namespace ensonify::logger {

/// Kongsberg .all, model 2040: I, R, U; then P, A and C as they are due, N, X and Y of each ping; i at its end. A .wcd
/// has k of pings with a water column in place of N, X and Y.
class AllFormat : public Format {
 public:
  /// `mark` says that files are simulated.
  AllFormat(const LoggerConfig& config, std::string mark, Part part);

  std::string ending() const override { return part_ == Part::kSoundings ? ".all" : ".wcd"; }
  void begin(const FileStart& start, formats::Bytes& out) override;
  void moment(const Moment& moment, formats::Bytes& out) override;
  void ping(const LoggedSoundings& ping, formats::Bytes& out) override;
  using Format::ping;
  void end(formats::Bytes& out) override;

 private:
  std::uint16_t serial() const { return static_cast<std::uint16_t>(config_.serial); }
  void append(formats::Bytes& out, std::int64_t unix_ns, formats::all::Body body);
  void finish_attitude(formats::Bytes& out);

  LoggerConfig config_;
  std::string mark_;
  Part part_;
  std::string file_name_;
  formats::all::Writer writer_;
  std::int64_t last_ns_ = 0;         // of what was written
  formats::all::Attitude attitude_;  // of the second that is not over
  std::int64_t attitude_begin_ns_ = 0;
  std::optional<formats::all::Runtime> runtime_;  // as last written
};

}  // namespace ensonify::logger
