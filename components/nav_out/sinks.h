#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "components/nav_out/output.h"
#include "components/transport/send_stream.h"

namespace ensonify::nav_out {

/// Where the bytes of all outputs go: ports, lines and files.
class Sinks {
 public:
  /// Files are made in `folder`. Throws UserError, with the output's name, where one cannot be opened.
  Sinks(const std::vector<Output>& outputs, const std::filesystem::path& folder);

  /// Never waits; but a file takes all.
  void put(std::size_t output, const std::string& bytes);
  /// Sends what waits, for two seconds at most.
  void finish();

  struct Counts {
    std::string name;
    std::int64_t pieces = 0, bytes = 0;  // put
    SendStream::Counts sent;             // of a file: nothing is lost
  };
  /// By output.
  std::vector<Counts> counts() const;

 private:
  struct Sink {
    std::string name;
    std::variant<std::unique_ptr<SendStream>, std::ofstream> to;
    std::int64_t pieces = 0, bytes = 0;
  };
  std::vector<Sink> sinks_;
};

}  // namespace ensonify::nav_out
