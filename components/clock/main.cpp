#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "components/clock/clock.h"
#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/runtime/log.h"
#include "components/runtime/tool.h"
#include "launch/process/run.h"
#include "scenarios/world/world.h"

namespace {

using namespace ensonify;

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

int run_clock(const LaunchOptions& options, const std::string& run_dir) {
  const Launch launch = read_launch(options);
  bus::Address address;
  address.tcp = launch.clock.transport == ClockSettings::Transport::kTcp;
  address.run_dir = run_dir;
  address.host = launch.clock.address;
  address.port = launch.clock.port;
  if (address.tcp && launch.clock.keys) address.keys = bus::Keys::read(run_dir + "/" + bus::kKeysFile);
  int code = 0;
  {
    bus::Router router(address);
    write_endpoint(run_dir, router.endpoint());
    code = clock::Clock(launch, router, options.out, read_whole).run();
  }
  std::error_code ignored;  // somebody may have removed it already
  std::filesystem::remove_all(run_dir, ignored);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ensonify-conductor: the clock process of a run. `ensonify run` starts it; `ensonify clock` asks it.");
  LaunchOptions options;
  std::string run_dir;
  add_options(app, options, false);
  app.add_option("--run-dir", run_dir, "private directory of the run; removed at the end")->required();
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  std::signal(SIGTERM, [](int) { clock::request_stop(); });
  std::signal(SIGINT, [](int) { clock::request_stop(); });
  return exit_code_of([&] { return run_clock(options, run_dir); });
}
