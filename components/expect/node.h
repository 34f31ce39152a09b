#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "components/expect/check.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// Judges a run by the launch file's expectations, in sim time, and writes <out>/expect.json.
class ExpectNode {
 public:
  using Config = ExpectConfig;
  static constexpr const char* kComponent = "expect";

  ExpectNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);
  void finish_run();
  /// 0 all held; 1 one failed; 6 only comparisons with records failed.
  int exit_code() const { return exit_code_; }

 private:
  struct Watch {
    Expectation expectation;
    std::unique_ptr<expect::Check> check;
  };

  void check_fields() const;

  Ports& ports_;
  Periodic events_;
  std::vector<Watch> watches_;
  std::map<std::string, std::vector<expect::Check*>> by_topic_;
  bool fields_checked_ = false;
  int exit_code_ = 0;
};

}  // namespace ensonify
