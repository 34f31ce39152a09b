#include "components/runtime/run_finder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "components/errors/exit_error.h"

namespace ensonify {

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

/// A folder of run directories, removed at the end, and an environment without $ENSONIFY_RUN.
class Runs {
 public:
  Runs() {
    ::unsetenv("ENSONIFY_RUN");
    std::string name = (fs::temp_directory_path() / "ens-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Runs() { fs::remove_all(path_); }

  /// A run directory that says where its clock is.
  std::string make(const std::string& id) const {
    fs::create_directory(path_ / id);
    std::ofstream(path_ / id / "clock.endpoint") << "ipc://" << (path_ / id / "clock").string();
    return (path_ / id).string();
  }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

/// Somebody who listens where a run's clock would.
class Listener {
 public:
  explicit Listener(const std::string& run) : fd_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, (run + "/clock").c_str(), sizeof address.sun_path - 1);
    REQUIRE(::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    REQUIRE(::listen(fd_, 1) == 0);
  }
  ~Listener() { ::close(fd_); }

 private:
  int fd_;
};

}  // namespace

TEST_CASE("the only live run is found, a dead one beside it is not in the way") {
  const Runs runs;
  runs.make("run-dead");
  const std::string live = runs.make("run-live");
  const Listener clock(live);
  CHECK(find_run("", runs.path()).endpoint == "ipc://" + live + "/clock");
  REQUIRE(live_runs(runs.path()).size() == 1);
  CHECK(live_runs(runs.path()).front().id() == "run-live");
  CHECK(dead_runs(runs.path()) == std::vector<std::string>{runs.path() + "/run-dead"});
}

TEST_CASE("none, several and dead runs are distinguished, with advice") {
  const Runs runs;
  CHECK_THROWS_WITH(find_run("", runs.path()),
                    Contains("no run is live under " + runs.path()) && Contains("`ensonify run LAUNCH` starts one"));
  const std::string a = runs.make("run-a");
  CHECK_THROWS_WITH(find_run("run-a", runs.path()), Contains("run-a: is dead: no clock listens at ipc://"));
  const Listener clock_a(a);
  const std::string b = runs.make("run-b");
  const Listener clock_b(b);
  write_about(b, {"bay", "/launch/demo.yaml", "/out", 0, 7});
  CHECK_THROWS_WITH(find_run("", runs.path()),
                    Contains("several runs are live; name one with --run NAME:\n  run-a: of unknown launch\n"
                             "  bay: /launch/demo.yaml, ") &&
                        Contains(" d old, process 7"));
  CHECK(find_run("bay", runs.path()).endpoint == "ipc://" + b + "/clock");
  CHECK(find_run("run-b", runs.path()).endpoint == "ipc://" + b + "/clock");
  CHECK(find_run(a, runs.path()).endpoint == "ipc://" + a + "/clock");
  CHECK(find_run("ipc://" + a + "/clock", runs.path()).endpoint == "ipc://" + a + "/clock");
  CHECK_THROWS_WITH(find_run("run-c", runs.path()), "run-c: there is no run of this name; live runs: run-a, bay");
  CHECK_THROWS_AS(find_run("tcp://127.0.0.1:1", runs.path()), UserError);
}

TEST_CASE("a name of a run is short, plain, and no id of a directory") {
  for (const char* good : {"a", "bay_1.2-x", "_", "9"}) CHECK(fault_of_run_name(good).empty());
  for (const char* bad : {"", "-x", ".", "a b", "a/b", "run-1", "\xC3\xA4"})
    CHECK_FALSE(fault_of_run_name(bad).empty());
  CHECK(fault_of_run_name(std::string(40, 'x')).empty());
  CHECK_FALSE(fault_of_run_name(std::string(41, 'x')).empty());
}

TEST_CASE("what a run says of itself is read as it was written, or not at all") {
  const Runs runs;
  const std::string run = runs.make("run-a");
  CHECK(read_about(run).launch.empty());
  write_about(run, {"bay", "launch/\xFF.yaml", "out", 12, 34});
  CHECK(read_about(run).name == "bay");
  CHECK(read_about(run).began_unix_s == 12);
  std::ofstream(run + "/about.json") << R"({"name": 3})";
  CHECK(read_about(run).name.empty());
  CHECK_THROWS_AS(write_about(run + "/missing", {}), UserError);
}

TEST_CASE("the environment names a run, an argument overrules it") {
  const Runs runs;
  const std::string a = runs.make("run-a");
  const Listener clock_a(a);
  const std::string b = runs.make("run-b");
  const Listener clock_b(b);
  ::setenv("ENSONIFY_RUN", "run-a", 1);
  CHECK(find_run("", runs.path()).endpoint == "ipc://" + a + "/clock");
  CHECK(find_run("run-b", runs.path()).endpoint == "ipc://" + b + "/clock");
  ::unsetenv("ENSONIFY_RUN");
}

TEST_CASE("a run that is starting holds its lock and is neither live nor dead") {
  const Runs runs;
  const std::string starting = runs.path() + "/run-new";
  fs::create_directory(starting);
  const int lock = ::open((starting + "/lock").c_str(), O_RDWR | O_CREAT, 0600);
  REQUIRE(::flock(lock, LOCK_EX | LOCK_NB) == 0);
  CHECK(live_runs(runs.path()).empty());
  CHECK(dead_runs(runs.path()).empty());
  ::close(lock);
  CHECK(dead_runs(runs.path()).size() == 1);
}

TEST_CASE("runs are looked for where the launcher puts them") {
  const std::string fallback = "/tmp/ensonify-" + std::to_string(::geteuid());
  const char* before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before != nullptr ? before : "";
  const Runs runs;
  ::setenv("XDG_RUNTIME_DIR", runs.path().c_str(), 1);
  CHECK(runs_folder() == runs.path() + "/ensonify");
  const std::string deep = runs.path() + "/" + std::string(kLongestRunsFolder, 'x');
  fs::create_directory(deep);
  ::setenv("XDG_RUNTIME_DIR", deep.c_str(), 1);
  CHECK(runs_folder() == fallback);
  ::setenv("XDG_RUNTIME_DIR", "/nowhere/at/all", 1);
  CHECK(runs_folder() == fallback);
  ::unsetenv("XDG_RUNTIME_DIR");
  CHECK(runs_folder() == fallback);
  if (before != nullptr) ::setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
}

}  // namespace ensonify
