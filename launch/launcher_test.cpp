#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "launch/child.h"
#include "launch/commands.h"
#include "launch/hosted.h"
#include "launch/memory.h"
#include "launch/report.h"
#include "launch/run_dir.h"

namespace ensonify::launcher {
namespace {

namespace fs = std::filesystem;

/// An empty folder, removed at the end, that stands in for $XDG_RUNTIME_DIR.
class RuntimeFolder {
 public:
  RuntimeFolder() : path_(fs::temp_directory_path() / ("launcher_test_" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
    ::setenv("XDG_RUNTIME_DIR", path_.c_str(), 1);
  }
  ~RuntimeFolder() {
    ::unsetenv("XDG_RUNTIME_DIR");
    fs::remove_all(path_);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Waits until the child has ended (the test's own time limit bounds it).
Ending ended(Child& child) {
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child.pid()), &info, WEXITED | WNOWAIT);
  while (child.running()) {
    if (const auto reaped = reap(); reaped && reaped->pid == child.pid()) {
      child.ended(reaped->wait_status, reaped->max_rss_kib, reaped->cpu_s);
    }
  }
  return *child.ending();
}

Child shell(const std::string& script, Command command = {}) {
  command.argv = {"/bin/sh", "-c", script};
  return Child(command);
}

std::string text_of(const std::string& file) { return tail(file, 1000); }

}  // namespace

TEST_CASE("a run directory is private, has its lock held, and goes with its owner") {
  const RuntimeFolder runtime;
  std::string path;
  {
    const RunDir dir;
    path = dir.path();
    CHECK(path.starts_with(runtime.file("ensonify/run-")));
    struct stat info {};
    REQUIRE(::stat(path.c_str(), &info) == 0);
    CHECK((info.st_mode & 0777) == 0700);
    const int other = ::open(dir.file("lock").c_str(), O_RDWR);
    CHECK(::flock(other, LOCK_EX | LOCK_NB) != 0);
    ::close(other);
  }
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("the next start clears the directories of dead runs and no others") {
  const RuntimeFolder runtime;
  const RunDir living;
  fs::create_directories(runtime.file("ensonify/run-dead01"));
  write_text(runtime.file("ensonify/run-dead01/lock"), "");
  write_text(runtime.file("ensonify/run-dead01/bow.sync"), "");
  const RunDir next;
  CHECK_FALSE(fs::exists(runtime.file("ensonify/run-dead01")));
  CHECK(fs::exists(living.path()));
  CHECK(living.path() != next.path());
  CHECK(remove_dead_runs(runtime.file("ensonify")) == 0);
}

TEST_CASE("a live run's name is refused to another, with who has it, and free when that has ended") {
  const RuntimeFolder runtime;
  {
    const RunDir bay({"bay", "/x/demo.yaml", "/x/out", 0, 42});
    const RunDir unnamed;
    CHECK_THROWS_WITH(
        RunDir({"bay", "other.yaml", "", 0, 43}),
        Catch::Contains("--name: bay is the name of a live run (/x/demo.yaml, ") && Catch::Contains("process 42"));
  }
  CHECK_NOTHROW(RunDir({"bay", "other.yaml", "", 0, 43}));
}

TEST_CASE("a second run cannot have an output folder that is in use") {
  const RuntimeFolder runtime;
  const std::string out = runtime.file("deep/out");
  {
    const OutFolder held(out);
    CHECK_THROWS_WITH(OutFolder(out), out + ": another run puts its results there; choose another folder with --out");
    const OutFolder other(out + "_2");
  }
  const OutFolder again(out);
  CHECK(fs::is_directory(out));
}

TEST_CASE("a runtime folder whose path is too long for sockets is not used") {
  const RuntimeFolder runtime;
  const std::string deep = runtime.file(std::string(80, 'x'));
  fs::create_directories(deep);
  ::setenv("XDG_RUNTIME_DIR", deep.c_str(), 1);
  CHECK(runs_folder() == "/tmp/ensonify-" + std::to_string(::geteuid()));
}

TEST_CASE("the first fault wins, and a failed assertion counts only when there was none") {
  Verdict verdict;
  CHECK(verdict.code() == 0);
  verdict.assertion_failed("expect", "no ping");
  CHECK(verdict.code() == 1);
  verdict.fault({kExitStall, "bow", "stalled"});
  verdict.fault({kExitDied, "auv", "died"});
  verdict.interrupted();
  CHECK(verdict.code() == 4);
  CHECK(verdict.cause()->culprit == "bow");

  Verdict interrupted;
  interrupted.interrupted();
  interrupted.fault({kExitDied, "auv", "died of being stopped"});
  CHECK(interrupted.code() == 130);
}

TEST_CASE("how a process ended decides what it means") {
  CHECK_FALSE(fault_of("bow", true, {0, 0}).has_value());
  CHECK(fault_of("bow", true, {0, SIGSEGV})->code == 3);
  CHECK(fault_of("bow", true, {0, SIGKILL})->message == "was killed by signal 9 (Killed)");
  CHECK(fault_of("bow", true, {2, 0})->code == 2);
  CHECK(fault_of("bow", true, {5, 0})->code == 5);
  CHECK(fault_of("pilot", true, {1, 0})->code == 1);  // it gave its mission up
  CHECK(fault_of("bow", true, {127, 0})->code == 3);
  CHECK(fault_of("expect", true, {1, 0})->code == 1);
  CHECK(fault_of("agent", false, {1, 0})->code == 3);  // an uncaught exception in Python
  CHECK(fault_of("agent", false, {2, 0})->code == 2);
  CHECK(fault_of("agent", false, {4, 0})->code == 3);
}

TEST_CASE("of faults noticed together a death by signal is reported first, then the clock") {
  const Fault killed{kExitDied, "bow", "was killed by signal 9 (Killed)"};
  const Fault clock{kExitStall, "clock", "stalled"};
  const Fault follower{kExitDied, "auv", "died (exit code 3)"};
  CHECK(most_significant({follower, clock, killed}).culprit == "bow");
  CHECK(most_significant({follower, clock}).culprit == "clock");
  CHECK(most_significant({follower}).culprit == "auv");
}

TEST_CASE("memory is bounded by process and for the run as a whole, and who holds the most is named") {
  const Held small{"auv", {150.0, 100.0}, std::nullopt};
  Held large{"agent", {900.0, 800.0}, 1000.0};
  CHECK_FALSE(too_much_memory({small, large}, 1125.0));  // 900 of their own: 80 %
  const auto together = too_much_memory({small, large}, 1124.0);
  REQUIRE(together);
  CHECK(together->culprit == "agent");
  CHECK(together->code == kExitDied);
  large.most_mb = 899.0;
  const auto alone = too_much_memory({small, large}, 1e6);
  REQUIRE(alone);
  CHECK(alone->message == "holds 900 MB of memory, its memory_mb is 899");
}

TEST_CASE("memory of a group is that of all its processes") {
  ::setpgid(0, 0);  // alone: a test runner's group has other tests
  const pid_t group = ::getpgrp();
  const auto before = resident_of({group});
  REQUIRE(before.contains(group));
  const std::vector<char> block(100'000'000, 'x');
  const auto after = resident_of({group}).at(group);
  // 100 MB were written; the kernel counts pages in batches of at most 64 per thread, 0.3 MB.
  CHECK(after.all_mb - before.at(group).all_mb > 99.0);
  CHECK(after.own_mb - before.at(group).own_mb > 99.0);
  CHECK(after.all_mb < machine_mb());
  CHECK(block.back() == 'x');
  CHECK(resident_of({}).empty());
}

TEST_CASE("a child runs in its own group, writes its log and gets its environment") {
  const RuntimeFolder folder;
  const Signals signals;
  Command command;
  command.log_file = folder.file("child.log");
  command.env = {{"ENSONIFY_NAME", "agent"}};
  Child child = shell("echo $ENSONIFY_NAME; echo oops >&2; ps -o pgid= -p $$ | tr -d ' '; exit 5", command);
  CHECK(ended(child).exit_code == 5);
  CHECK(text_of(command.log_file) == "agent\noops\n" + std::to_string(child.pid()));
  CHECK(child.max_rss_kib() > 0);
}

TEST_CASE("what a child started goes with it") {
  const Signals signals;
  int pipe_fds[2];
  REQUIRE(::pipe2(pipe_fds, O_CLOEXEC) == 0);
  Command command;
  command.keep_fd = pipe_fds[1];
  Child child = shell("sleep 1000 & exit 0", command);
  ::close(pipe_fds[1]);
  CHECK(ended(child).exit_code == 0);
  char byte = 0;
  CHECK(::read(pipe_fds[0], &byte, 1) == 0);  // end of file: the last holder of the pipe is gone
  ::close(pipe_fds[0]);
}

TEST_CASE("a child that has ended already is not waited for, one that runs on is killed") {
  using std::chrono::milliseconds;
  Signals signals;
  Child quick = shell("exit 7");
  REQUIRE(signals.wait(milliseconds(-1)));  // its signal is here, and not taken
  const auto ending = end_within(quick, signals, milliseconds(0));
  REQUIRE(ending.has_value());
  CHECK(ending->exit_code == 7);

  Child idle = shell("exec sleep 1000");
  CHECK_FALSE(end_within(idle, signals, milliseconds(0)).has_value());
  CHECK(idle.ending()->signal == SIGKILL);
}

TEST_CASE("a child that cannot start says why") {
  Command command;
  command.argv = {"/no/such/program"};
  CHECK_THROWS_WITH(Child(command), "/no/such/program: cannot be started: No such file or directory");
  command.argv = {"/bin/true"};
  command.log_file = "/no/such/folder/x.log";
  CHECK_THROWS_WITH(Child(command), "/no/such/folder/x.log: cannot be written: No such file or directory");
}

TEST_CASE("a killed launcher's guard ends the children and removes the run directory") {
  const RuntimeFolder runtime;
  int alive[2], named[2];
  REQUIRE(::pipe2(alive, O_CLOEXEC) == 0);
  REQUIRE(::pipe2(named, O_CLOEXEC) == 0);
  const pid_t launcher = ::fork();
  if (launcher == 0) {  // a launcher with one child that ignores SIGTERM
    const RunDir dir;
    ::close(alive[0]);
    std::ofstream(runtime.file("run_dir")) << dir.path();
    Guard guard(dir.path());
    Command command;
    command.keep_fd = alive[1];
    Child child = shell("trap '' TERM; while :; do sleep 1000; done", command);
    guard.watch(child.pid());
    ::close(named[1]);
    ::kill(::getpid(), SIGKILL);
  }
  ::close(alive[1]);
  ::close(named[1]);
  ::waitpid(launcher, nullptr, 0);
  char byte = 0;
  CHECK(::read(alive[0], &byte, 1) == 0);  // child and guard have gone
  const std::string run_dir = text_of(runtime.file("run_dir"));
  CHECK(run_dir.find("/ensonify/run-") != std::string::npos);
  // The guard holds the directory's lock through the pipe's other end until it has removed it.
  CHECK(::read(named[0], &byte, 1) == 0);
  CHECK_FALSE(fs::exists(run_dir));
  ::close(alive[0]);
  ::close(named[0]);
}

TEST_CASE("a guard that is dismissed touches nothing") {
  const RuntimeFolder runtime;
  const RunDir dir;
  Child child = shell("exec sleep 1000");
  {
    Guard guard(dir.path());
    guard.watch(child.pid());
  }
  CHECK(fs::exists(dir.path()));
  CHECK(::kill(child.pid(), 0) == 0);
  child.send(SIGKILL);
  CHECK(ended(child).signal == SIGKILL);
}

TEST_CASE("native and foreign processes get what they need to join") {
  const RuntimeFolder folder;
  std::ofstream(folder.file("x.yaml"))
      << "ensonify: launch/1\nprocesses:\n  bow: {run: multibeam}\n"
         "  agent: {run: [sh, -c, 'true'], config: {gain: 2}, env: {A: b}, cpus: [0]}\n"
         "  bad: {run: [no_such_program_here]}\n"
         "  worse: {run: vehicle, cpus: [4000]}\n";
  std::ofstream(folder.file("ensonify-multibeam")) << "#!/bin/sh\n";
  std::ofstream(folder.file("ensonify-vehicle")) << "#!/bin/sh\n";
  fs::permissions(folder.file("ensonify-multibeam"), fs::perms::owner_all);
  fs::permissions(folder.file("ensonify-vehicle"), fs::perms::owner_all);
  const Launch launch = read_launch({.file = folder.file("x.yaml"), .sets = {"bow.a=1"}, .out = "o"});
  const RunPlaces places{folder.file("."), "/run/dir", "o"};

  const Command bow = process_command(launch, launch.processes[0], places, "ipc:///run/dir/clock");
  CHECK(bow.argv == std::vector<std::string>{folder.file("./ensonify-multibeam"), "--launch", folder.file("x.yaml"),
                                             "--set", "bow.a=1", "--out", "o", "--run-dir", "/run/dir", "--name", "bow",
                                             "--clock", "ipc:///run/dir/clock"});
  CHECK(bow.log_file == "o/log/bow.log");
  CHECK(clock_command(launch, places).argv.back() == "/run/dir");
  CHECK(clock_command(launch, places).argv.front().ends_with("/ensonify-conductor"));
  CHECK(clock_command(launch, places, {"bow"}).argv.front().ends_with("/ensonify-host"));
  CHECK(clock_command(launch, places, {"bow"}).argv.back() == "bow");

  const Command agent = process_command(launch, launch.processes[1], places, "ipc:///run/dir/clock");
  CHECK(agent.argv[0].ends_with("/sh"));
  CHECK(agent.env.at("ENSONIFY_CLOCK") == "ipc:///run/dir/clock");
  CHECK(agent.env.at("ENSONIFY_NAME") == "agent");
  CHECK(agent.env.at("ENSONIFY_RUN_DIR") == "/run/dir");
  CHECK(agent.env.at("ENSONIFY_OUT") == "o");
  CHECK(agent.env.at("ENSONIFY_CONFIG") == R"({"gain":2})");
  CHECK(agent.env.at("A") == "b");
  CHECK(agent.cpus == std::vector<int>{0});

  CHECK_THROWS_WITH(process_command(launch, launch.processes[2], places, ""),
                    folder.file("x.yaml") + ":5:8: processes.bad.run: there is no program no_such_program_here");
  CHECK_THROWS_WITH(process_command(launch, launch.processes[3], places, ""),
                    folder.file("x.yaml") + ":6:10: processes.worse.cpus: CPU 4000 is not available to this launcher");
}

TEST_CASE("the clock's program hosts our own processes, but for those that need one of their own") {
  const RuntimeFolder folder;
  std::ofstream(folder.file("x.yaml"))
      << "ensonify: launch/1\n"
         "scenario: {ensonify: scenario/1, site: {latitude_deg: 1, longitude_deg: 2}}\n"
         "processes:\n"
         "  boat: {run: vehicle}\n"
         "  nav: {run: navigation, config: {}}\n"
         "  pinned: {run: navigation, cpus: [0]}\n"
         "  bounded: {run: navigation, memory_mb: 100}\n"
         "  varied: {run: navigation, env: {A: b}}\n"
         "  losable: {run: navigation, may_be_lost: true}\n"
         "  watcher: {run: navigation, observer: true}\n"
         "  away: {run: navigation, external: true}\n"
         "  killed: {run: navigation}\n"
         "  paused: {run: navigation}\n"
         "  muted: {run: navigation}\n"
         "  ended: {run: navigation}\n"
         "  keeper: {run: recorder}\n"
         "  agent: {run: [sh, x]}\n"
         "inject: [{kill: killed, at_s: 1}, {pause: paused, at_s: 1, for_wall_s: 1}, {mute: muted, from_s: 1}]\n"
         "expect: [{exit: {process: ended, code: 0}}]\n";
  const Launch launch = read_launch({.file = folder.file("x.yaml")});
  CHECK(hosted_processes(launch) == std::set<std::string>{"boat", "muted", "nav"});
}

TEST_CASE("the reports name what failed") {
  RunReport report;
  report.code = 3;
  report.cause = Fault{kExitDied, "bow", "was killed by signal 9 (Killed)"};
  report.sim_s = 20;
  report.wall_s = 4;
  report.processes = {{.name = "auv", .state = "DONE", .ending = Ending{0, 0}, .max_rss_kib = 7},
                      {.name = "bow", .state = "FAILED", .ending = Ending{0, 9}, .fault = report.cause}};
  report.expectations = {{"pings", true, 1.5, ""}, {"depth < 30 & \"flat\"", false, 2, "got 31\n"}};
  CHECK(junit_xml(report) ==
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite name=\"expect\" tests=\"2\" failures=\"1\">\n"
        "    <testcase classname=\"expect\" name=\"pings\" time=\"1.500\"/>\n"
        "    <testcase classname=\"expect\" name=\"depth &lt; 30 &amp; &quot;flat&quot;\" time=\"2.000\">\n"
        "      <failure message=\"got 31&#10;\"/>\n    </testcase>\n"
        "  </testsuite>\n"
        "  <testsuite name=\"processes\" tests=\"3\" failures=\"2\">\n"
        "    <testcase classname=\"process\" name=\"auv\" time=\"0.000\"/>\n"
        "    <testcase classname=\"process\" name=\"bow\" time=\"0.000\">\n"
        "      <failure message=\"was killed by signal 9 (Killed)\"/>\n    </testcase>\n"
        "    <testcase classname=\"run\" name=\"run\" time=\"4.000\">\n"
        "      <failure message=\"bow was killed by signal 9 (Killed)\"/>\n    </testcase>\n"
        "  </testsuite>\n</testsuites>\n");
  const std::string json = json_text(report);
  CHECK(json.find("\"exit_code\": 3") != std::string::npos);
  CHECK(json.find("\"culprit\": \"bow\"") != std::string::npos);
  CHECK(json.find("\"real_time_factor\": 5.0") != std::string::npos);
  CHECK(json.find("\"max_rss_kib\": 7") != std::string::npos);
}

TEST_CASE("results of expectations are read from what expect wrote") {
  const RuntimeFolder folder;
  CHECK(read_expectations(folder.file("expect.json")).empty());
  write_text(folder.file("expect.json"), R"([{"name": "a", "ok": false, "t_s": 3.5, "message": "m"}])");
  const auto read = read_expectations(folder.file("expect.json"));
  REQUIRE(read.size() == 1);
  CHECK(read[0].name == "a");
  CHECK_FALSE(read[0].ok);
  CHECK(read[0].t_s == 3.5);
  write_text(folder.file("expect.json"), "{");
  CHECK_THROWS_AS(read_expectations(folder.file("expect.json")), ExitError);
  CHECK_THROWS_AS(write_text("/dev/full", "x"), DataLost);
}

TEST_CASE("progress shows time, rate and what is left") {
  CHECK(progress_text(30, 3, 90, "RUNNING") == "t 30.0 s  10.0x real time  about 6 s left  RUNNING");
  CHECK(progress_text(30, 3, 3000, "RUNNING") == "t 30.0 s  10.0x real time  about 4 min 57 s left  RUNNING");
  CHECK(progress_text(30, 3, std::nullopt, "PAUSED") == "t 30.0 s  10.0x real time  PAUSED");
  CHECK(progress_text(0, 0, 90, "READY") == "t 0.0 s  0.0x real time  READY");
}

TEST_CASE("a mission's length gives the time that a run will take") {
  Launch launch;
  World world;
  CHECK_FALSE(expected_duration_s(launch, world).has_value());
  world.mission.speed_mps = 2;
  world.mission.run_in_m = 0;
  world.vehicles.resize(1);
  world.vehicles[0].limits.turning_radius_m = 10;
  // Two lines of 100 m, 20 m apart, joined by a half circle of radius 10 m.
  world.mission.runlines = {{{0, 0}, {0, 100}}, {{20, 100}, {20, 0}}};
  CHECK(*expected_duration_s(launch, world) == Approx((200 + 3.14159265 * 10) / 2));
  launch.duration = SimTime{5'000'000'000};
  CHECK(*expected_duration_s(launch, world) == 5.0);
}

}  // namespace ensonify::launcher
