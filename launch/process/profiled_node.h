#pragma once

#include <memory>
#include <string>

#include "components/runtime/stepper.h"

namespace ensonify {

/// Set for a process whose run is profiled (`ensonify run --profile`).
inline constexpr const char* kProfileVariable = "ENSONIFY_PROFILE";
/// Folder of a run where each of its processes writes its profile.
inline std::string profile_folder(const std::string& out) { return out + "/profile"; }

/// A node whose work is measured by stage (kernels/base/profile), from its first event on.
class ProfiledNode : public AnyNode {
 public:
  explicit ProfiledNode(std::unique_ptr<AnyNode> node) : node_(std::move(node)) {}

  SimTime step(SimTime now) override;
  void finish_run() override { node_->finish_run(); }
  int exit_code() const override { return node_->exit_code(); }
  bool completes_files() const override { return node_->completes_files(); }

 private:
  std::unique_ptr<AnyNode> node_;
};

/// Writes what was measured of this process, over all epochs, as JSON: `process`, `wall_s` and `processor_s` from the
/// first event to now, `stages` by name (`count`, `wall_s`, `processor_s`), and `traceEvents` as Perfetto and Chrome
/// read them. Throws ExitError (5).
void write_profile(const std::string& file, const std::string& process);

}  // namespace ensonify
