#include "tools/console/logs.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace ensonify;
using namespace ensonify::console;

namespace {

namespace fs = std::filesystem;

struct Folder {
  std::string path;
  Folder() {
    char name[] = "/tmp/ensonify-logs-XXXXXX";
    path = ::mkdtemp(name);
  }
  ~Folder() { fs::remove_all(path); }
  void add(const std::string& file, const std::string& text) {
    std::ofstream(path + "/" + file, std::ios::app) << text;
  }
};

std::vector<std::string> texts(const Logs& logs, Logs::Seen& seen) {
  std::vector<std::string> lines;
  while (const auto news = logs.news(seen))
    for (const auto& line : news->lines) lines.push_back(line.process + ": " + line.text);
  return lines;
}

}  // namespace

TEST_CASE("lines of several logs come in the order of sim time, and then as they are written") {
  Folder folder;
  folder.add("bow.log", "t=1.000 bow a\nt=3.000 bow c\n");
  folder.add("nav.log", "t=2.000 nav b\nhalf a li");
  folder.add("notes.txt", "t=0.000 no log\n");
  Logs logs;
  Logs::Seen seen;
  logs.read(folder.path);
  CHECK(texts(logs, seen) ==
        std::vector<std::string>{"bow: t=1.000 bow a", "nav: t=2.000 nav b", "bow: t=3.000 bow c"});
  folder.add("nav.log", "ne\n");
  logs.read(folder.path);
  CHECK(texts(logs, seen) == std::vector<std::string>{"nav: half a line"});
  logs.read(folder.path);
  CHECK(texts(logs, seen).empty());
}

TEST_CASE("links are not followed") {
  Folder folder;
  fs::create_symlink("/etc/passwd", folder.path + "/link.log");
  Logs logs;
  Logs::Seen seen;
  logs.read(folder.path);
  CHECK_FALSE(logs.news(seen));
}

TEST_CASE("the newest thousand lines are kept, long ones are cut, control characters are no more") {
  Folder folder;
  for (int i = 0; i < 3000; ++i) folder.add("a.log", "line " + std::to_string(i) + "\n");
  folder.add("a.log", std::string(5000, 'x') + "\n\x1b[31mred\n");
  Logs logs;
  for (int i = 0; i < 3; ++i) logs.read(folder.path);
  Logs::Seen seen;
  const auto lines = texts(logs, seen);
  REQUIRE(lines.size() == Logs::kMostLines);
  CHECK(lines[998].size() == Logs::kMostBytes + 3);
  CHECK(lines[999].find('\x1b') == std::string::npos);
  CHECK(lines[997] == "a: line 2999");
}

TEST_CASE("a log that has become shorter is another run's") {
  Folder folder;
  folder.add("a.log", "one\ntwo\n");
  Logs logs;
  Logs::Seen seen;
  logs.read(folder.path);
  CHECK(texts(logs, seen).size() == 2);
  std::ofstream(folder.path + "/a.log") << "new\n";
  logs.read(folder.path);
  logs.read(folder.path);
  CHECK(texts(logs, seen) == std::vector<std::string>{"a: new"});
}

TEST_CASE("levels follow from words") {
  CHECK(level_of("t=1.000 bow late_ping ping=5") == "warning");
  CHECK(level_of("bow.yaml:3:1: Error: is not a known key") == "error");
  CHECK(level_of("t=0.000 clock go epoch=1") == "info");
}
