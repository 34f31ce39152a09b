#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/topic/publish.h"

namespace ensonify::topic_tool {

/// Options of the user; each verb uses its own.
struct Options {
  std::string run;
  bool json = false;
  std::vector<std::string> topics;  // names or patterns
  std::uint64_t count = 0;          // leave after so many messages; 0: never
  double timeout_s = 0.0;           // leave after so long, wall time; 0: never
  std::string field;                // echo: only this one
  bool full = false;                // echo --json: every element of every array
  std::uint64_t window = 1000;      // hz, bw: messages that the rates are taken over
  Publication publication;          // pub
};

/// Each verb returns the program's exit code.
int list(const Options& options);
int info(const Options& options);
int echo(const Options& options);
int hz(const Options& options);
int bw(const Options& options);

}  // namespace ensonify::topic_tool
