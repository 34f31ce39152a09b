#include "components/clock/program.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "components/clock/clock.h"
#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/runtime/host.h"
#include "components/runtime/tool.h"
#include "launch/process/launch_wiring.h"
#include "scenarios/world/world.h"

namespace ensonify::clock {
namespace {

struct Options {
  LaunchOptions launch;
  std::string run_dir;
  std::vector<std::string> hosted;  // processes
};

/// Publishes to all where the clock is. Renamed into place, so that whoever sees the file sees all of it.
void write_endpoint(const std::filesystem::path& run_dir, const std::string& endpoint) {
  const std::filesystem::path unfinished = run_dir / "clock.endpoint.new";
  std::ofstream file(unfinished);
  file << endpoint;
  file.close();
  if (!file) {
    throw UserError(unfinished.string() + ": cannot be written: " + std::strerror(errno) +
                    "; allowed: a folder with room, see XDG_RUNTIME_DIR");
  }
  std::filesystem::rename(unfinished, run_dir / "clock.endpoint");
}

Launch read_whole(const LaunchOptions& options) {
  return read_launch(options, [](ConfigReader& from, const std::string& file) { read_world(from, file); });
}

bus::Address address_of(const ClockSettings& settings, const std::string& run_dir) {
  bus::Address address;
  address.tcp = settings.transport == ClockSettings::Transport::kTcp;
  address.run_dir = run_dir;
  address.host = settings.address;
  address.port = settings.port;
  if (address.tcp && settings.keys) address.keys = bus::Keys::read(run_dir + "/" + bus::kKeysFile);
  return address;
}

/// The launch as an epoch has it, read once for the clock and all that live beside it.
class EpochLaunch {
 public:
  EpochLaunch(const LaunchOptions& first, Launch launch) : first_(first), options_(first), launch_(std::move(launch)) {}

  /// From its files, for the clock, which is asked first.
  const Launch& read(const LaunchOptions& options) {
    launch_ = read_whole(options);
    options_ = options;
    return launch_;
  }
  const Launch& of(const EpochOptions& epoch) {
    const LaunchOptions options = epoch.out.empty() ? first_ : options_of(epoch, first_);
    return options == options_ ? launch_ : read(options);
  }

 private:
  LaunchOptions first_;
  LaunchOptions options_;  // that launch_ was read with
  Launch launch_;
};

/// All mistakes in their configurations are named at once.
void add_members(Host& host, const std::vector<std::string>& names, EpochLaunch& launch,
                 const std::map<std::string, NodeFactory>& components) {
  std::string problems;
  for (const std::string& name : names) {
    const OpenSession open = [&launch, &components, name](const EpochOptions& epoch) {
      const Launch& now = launch.of(epoch);
      const ProcessSpec& process = now.process(name);
      const auto factory = components.find(process.component);
      if (factory == components.end()) throw UserError(name + ": cannot be hosted: " + process.component);
      return std::make_unique<Session>(process.component, name, now.options.out,
                                       [&](Ports& ports) { return factory->second(now, process, ports); });
    };
    try {
      host.add(open);
    } catch (const UserError& e) {
      problems += (problems.empty() ? "" : "\n") + std::string(e.what());
    }
  }
  if (!problems.empty()) throw UserError(problems);
}

int run(const Options& options, const std::map<std::string, NodeFactory>& components) {
  EpochLaunch launch(options.launch, read_launch(options.launch));
  const Launch& first = launch.of({});
  use_isa(isa_of(first));
  int code = 0;
  {
    bus::Address address = address_of(first.clock, options.run_dir);
    bus::Router router(address);
    address.port = 0;
    if (address.tcp) address.host = bus::host_towards(router.endpoint());
    Host host(router, address);
    add_members(host, options.hosted, launch, components);
    write_endpoint(options.run_dir, router.endpoint());  // others may be started
    host.join();
    bus::ControlPlane& control = options.hosted.empty() ? static_cast<bus::ControlPlane&>(router) : host;
    code =
        Clock(first, control, options.launch.out, [&](const LaunchOptions& next) { return launch.read(next); }).run();
  }
  std::error_code ignored;  // somebody may have removed it already
  std::filesystem::remove_all(options.run_dir, ignored);
  return code;
}

int main_of(CLI::App& app, int argc, char** argv, Options& options,
            const std::map<std::string, NodeFactory>& components) {
  add_options(app, options.launch, false);
  app.add_option("--run-dir", options.run_dir, "private directory of the run; removed at the end")->required();
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  std::signal(SIGTERM, [](int) { request_stop(); });
  std::signal(SIGINT, [](int) { request_stop(); });
  return exit_code_of([&] { return run(options, components); });
}

}  // namespace

int clock_main(int argc, char** argv) {
  CLI::App app("ensonify-conductor: the clock process of a run. `ensonify run` starts it; `ensonify clock` asks it.");
  Options options;
  return main_of(app, argc, argv, options, {});
}

int host_main(int argc, char** argv, const std::map<std::string, NodeFactory>& components) {
  CLI::App app("ensonify-host: the clock of a run and processes beside it in one program; `ensonify run --hosted`.");
  Options options;
  app.add_option("--host", options.hosted, "a process of the launch that lives here; may be given several times");
  return main_of(app, argc, argv, options, components);
}

}  // namespace ensonify::clock
