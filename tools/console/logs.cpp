#include "tools/console/logs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "components/errors/printable.h"

namespace ensonify::console {

namespace {

namespace fs = std::filesystem;

constexpr const char* kErrors[] = {"error", "fail", "fatal", "cannot", "refused"};
constexpr const char* kWarnings[] = {"warn", "late", "lost", "missed", "skipped", "slip", "degraded"};

/// Sim time of a line such as "t=12.340 bow late_ping ping=57"; that of the line before where it has none.
double time_of(const std::string& line, double before_s) {
  if (!line.starts_with("t=")) return before_s;
  char* end = nullptr;
  const double time_s = std::strtod(line.c_str() + 2, &end);
  return end == line.c_str() + 2 ? before_s : time_s;
}

}  // namespace

std::string level_of(const std::string& line) {
  std::string text = line;
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto says = [&](const char* word) { return text.find(word) != std::string::npos; };
  if (std::any_of(std::begin(kErrors), std::end(kErrors), says)) return "error";
  return std::any_of(std::begin(kWarnings), std::end(kWarnings), says) ? "warning" : "info";
}

void Logs::clear() {
  const std::int64_t next = generation_ + 1;
  *this = Logs();
  generation_ = next;
}

void Logs::read(const std::string& folder) {
  if (folder != folder_ && !folder_.empty()) clear();
  folder_ = folder;
  std::deque<Line> fresh;
  std::error_code error;
  std::size_t files = 0;
  for (fs::directory_iterator it(folder, error); !error && it != fs::directory_iterator(); it.increment(error)) {
    if (it->path().extension() != ".log" || ++files > kMostFiles) continue;
    if (!read_file(it->path().string(), it->path().stem().string(), fresh)) return clear();
  }
  std::stable_sort(fresh.begin(), fresh.end(), [](const Line& a, const Line& b) { return a.time_s < b.time_s; });
  for (Line& line : fresh) lines_.push_back(std::move(line.line));
  while (lines_.size() > kMostLines) {
    lines_.pop_front();
    ++first_;
  }
}

/// False where the file has become shorter: it is another run's.
bool Logs::read_file(const std::string& path, const std::string& process, std::deque<Line>& fresh) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (fd < 0) return true;
  File& file = files_[process];
  struct ::stat about {};
  const bool regular = ::fstat(fd, &about) == 0 && S_ISREG(about.st_mode);
  const bool same = file.at <= about.st_size;
  if (regular && same) {
    const std::int64_t tail = about.st_size - static_cast<std::int64_t>(kMostRead);
    const bool cut = file.at < 0 && tail > 0;
    if (file.at < 0) file.at = std::max<std::int64_t>(0, tail);
    std::string text(kMostRead, '\0');
    const auto got = ::pread(fd, text.data(), text.size(), file.at);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    file.at += static_cast<std::int64_t>(text.size());
    text = file.rest + text;
    std::size_t begin = cut ? std::min(text.find('\n'), text.size() - 1) + 1 : 0;
    for (std::size_t end = text.find('\n', begin); end != std::string::npos; end = text.find('\n', begin)) {
      const std::string line = printable(text.substr(begin, std::min(end - begin, kMostBytes)));
      begin = end + 1;
      if (line.empty()) continue;
      file.time_s = time_of(line, file.time_s);
      fresh.push_back({file.time_s, {printable(process), level_of(line), line}});
      if (fresh.size() > kMostLines) fresh.pop_front();
    }
    file.rest = text.substr(std::min(begin, text.size()));
    if (file.rest.size() > kMostRead) file.rest.clear();
  }
  ::close(fd);
  return !regular || same;
}

std::optional<msg::ConsoleLog> Logs::news(Seen& seen) const {
  if (seen.generation != generation_) seen = {generation_, 0};
  seen.lines = std::max(seen.lines, first_);
  const auto begin = static_cast<std::size_t>(seen.lines - first_);
  const std::size_t count = std::min(lines_.size() - std::min(begin, lines_.size()), kMostLinesAtOnce);
  if (count == 0) return std::nullopt;
  msg::ConsoleLog log{generation_, seen.lines, {}};
  for (std::size_t i = 0; i < count; ++i) log.lines.push_back(lines_[begin + i]);
  seen.lines += static_cast<std::int64_t>(count);
  return log;
}

}  // namespace ensonify::console
