#include "components/runtime/session.h"

namespace ensonify {

Session::Session(const std::string& component, const std::string& process, const std::filesystem::path& out_dir,
                 const MakeNode& make)
    : ports_(process, out_dir),
      node_(make(ports_)),
      stepper_(ports_, [this](SimTime now) { return node_->step(now); }) {
  ports_.seal();
  declaration_ = declaration_of(component, ports_);
}

}  // namespace ensonify
