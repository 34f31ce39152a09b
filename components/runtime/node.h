#pragma once

#include "components/runtime/ports.h"

namespace ensonify {

/// A component's node behind one interface: what the participant's loop and the in-process runner drive.
class AnyNode {
 public:
  virtual ~AnyNode() = default;
  virtual SimTime step(SimTime now) = 0;
  /// The run has ended in order: files are completed here, where an error can still be reported.
  virtual void finish_run() = 0;
  /// Exit code of the process after an orderly end.
  virtual int exit_code() const = 0;
};

template <class Node>
class NodeHolder : public AnyNode {
 public:
  NodeHolder(const typename Node::Config& config, Ports& ports) : node_(config, ports) {}
  SimTime step(SimTime now) override { return node_.step(now); }
  void finish_run() override {
    if constexpr (requires { node_.finish_run(); }) node_.finish_run();
  }
  int exit_code() const override {
    if constexpr (requires { node_.exit_code(); }) return node_.exit_code();
    else return 0;
  }
  Node& node() { return node_; }

 private:
  Node node_;
};

}  // namespace ensonify
