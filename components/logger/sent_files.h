#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "components/logger/config.h"
#include "components/logger/survey_log.h"
#include "components/transport/send_stream.h"

namespace ensonify::logger {

/// Files whose datagrams are also sent, as instruments send them: .all without lengths, .kmall in parts. A receiver of
/// a water column and of the format beside it gets of the first only what the second does not have.
class SentFiles : public Files {
 public:
  /// `files` outlives this. Throws UserError where a receiver's interface is not there.
  SentFiles(const LoggerConfig& config, Files& files);

  void open(std::size_t format, const std::string& name) override { files_.open(format, name); }
  void put(std::size_t format, const formats::Bytes& bytes) override;
  void close(std::size_t format) override { files_.close(format); }
  std::uint64_t bytes(std::size_t format) const override { return files_.bytes(format); }

  /// Sends what waits, for two seconds at most.
  void finish();

  struct Counts {
    std::string to;
    std::int64_t datagrams = 0;  // and parts, offered to it
    std::int64_t bytes = 0;      // of these
    SendStream::Counts sent;
  };
  /// By receiver.
  std::vector<Counts> counts() const;

 private:
  struct Receiver {
    std::string to;
    SentFormats formats;
    std::unique_ptr<SendStream> stream;
    std::int64_t datagrams = 0, bytes = 0;
  };

  static bool wants(const Receiver& receiver, const std::string& format, formats::ByteView datagram);

  LoggedFormats formats_;
  Files& files_;
  std::vector<Receiver> receivers_;
};

}  // namespace ensonify::logger
