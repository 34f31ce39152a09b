#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "components/runtime/stepper.h"
#include "components/runtime/wiring.h"

namespace ensonify {

/// Constructs a node, which declares its ports.
using MakeNode = std::function<std::unique_ptr<AnyNode>(Ports&)>;

/// A node, its ports and what runs its events: everything that a process makes anew for each epoch.
class Session {
 public:
  Session(const std::string& component, const std::string& process, const std::filesystem::path& out_dir,
          const MakeNode& make);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Declaration& declaration() const { return declaration_; }
  const Ports& ports() const { return ports_; }
  AnyNode& node() { return *node_; }
  const AnyNode& node() const { return *node_; }
  Stepper& stepper() { return stepper_; }
  const Stepper& stepper() const { return stepper_; }

 private:
  Ports ports_;
  std::unique_ptr<AnyNode> node_;
  Stepper stepper_;
  Declaration declaration_;
};

/// What an epoch has of its own.
struct EpochOptions {
  std::vector<std::string> sets;  // as --set takes them, behind those of the launch
  std::string out;                // folder of its results; "": the launch's
};

/// Makes a process's session for an epoch: for the first of a run, then for each that a reset begins.
using OpenSession = std::function<std::unique_ptr<Session>(const EpochOptions&)>;

}  // namespace ensonify
