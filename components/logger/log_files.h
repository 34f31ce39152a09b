#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "components/logger/survey_log.h"
#include "components/record/record_file.h"

namespace ensonify::logger {

/// Files in a folder, which is made with the first. One that the disk does not take ends with a whole datagram.
class LogFiles : public Files {
 public:
  explicit LogFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void open(std::size_t format, const std::string& name) override;
  void put(std::size_t format, const formats::Bytes& bytes) override;
  void close(std::size_t format) override;
  std::uint64_t bytes(std::size_t format) const override;

 private:
  std::filesystem::path folder_;
  std::vector<std::unique_ptr<record::RecordFile>> files_;  // by format
};

}  // namespace ensonify::logger
