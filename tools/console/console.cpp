#include "tools/console/console.h"

#include <algorithm>
#include <filesystem>

#include "components/errors/exit_error.h"
#include "components/runtime/run_finder.h"
#include "tools/console/blind.h"
#include "tools/console/viewer.h"

namespace ensonify::console {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRun = "run:";
constexpr std::string_view kRecord = "record:";
constexpr std::chrono::seconds kKeepDesk{5};  // after its last viewer has left
constexpr std::size_t kMostItems = 200;
constexpr int kDeepest = 4;
constexpr int kMostEntries = 20'000;  // of folders that are gone through: nobody waits for a whole disk

/// Records below a folder, without links and hidden names.
std::vector<std::string> records_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  int entries = 0;
  for (; !error && it != fs::recursive_directory_iterator() && entries < kMostEntries; it.increment(error)) {
    ++entries;
    const bool hidden = it->path().filename().string().starts_with(".");
    if (it->is_symlink(error) || hidden || it.depth() > kDeepest) {
      it.disable_recursion_pending();
      continue;
    }
    if (it->is_regular_file(error) && it->path().extension() == ".mcap") found.push_back(it->path().string());
    if (found.size() >= kMostItems) break;
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Console::Console(ConsoleOptions options, Doors& doors) : options_(std::move(options)), doors_(doors) {}
Console::~Console() = default;

std::unique_ptr<Visitor> Console::enter(Line& line) {
  if (viewers_.size() >= kMostViewers) {
    count_refused("viewers beyond 16");
    return nullptr;
  }
  auto viewer = std::make_unique<Viewer>(*this, line, std::chrono::steady_clock::now());
  viewers_.push_back(viewer.get());
  return viewer;
}

void Console::leave(Viewer& viewer) { viewers_.remove(&viewer); }

std::vector<msg::ConsoleItem> Console::items() const {
  std::vector<msg::ConsoleItem> items;
  if (options_.blind) return items;
  for (const LiveRun& run : live_runs(runs_folder()))
    items.push_back({std::string(kRun) + run.id(), "run", run.id() + ": " + run.about.text()});
  if (options_.folder.empty()) return items;
  for (const std::string& file : records_in(options_.folder))
    items.push_back(
        {std::string(kRecord) + file, "record", fs::path(file).lexically_relative(options_.folder).string()});
  return items;
}

std::shared_ptr<Desk> Console::desk(const std::string& id) {
  if (const auto known = desks_.find(id); known != desks_.end()) return known->second;
  const auto listed = items();
  if (id != options_.first &&
      std::none_of(listed.begin(), listed.end(), [&](const auto& item) { return item.id == id; }))
    throw UserError(id + ": is no live run and no record of this console's list");
  if (desks_.size() >= kMostDesks)
    throw UserError("four runs or records are open, which is the most; close a page that shows another");
  std::unique_ptr<Source> source;
  if (id.starts_with(kRun)) source = live_source(id.substr(kRun.size()));
  else source = record_source(id.substr(kRecord.size()), options_.record);
  if (options_.blind) source = blind(std::move(source));
  return desks_[id] = std::make_shared<Desk>(std::move(source), options_.alarms);
}

void Console::tick(WallTime now) {
  std::erase_if(desks_,
                [&](const auto& entry) { return entry.second->empty() && now - entry.second->left() > kKeepDesk; });
  for (const auto& [id, desk] : desks_) {
    if (!desk->poll(now)) continue;
    for (Viewer* viewer : viewers_)
      if (viewer->desk() == desk.get()) viewer->send_state();
  }
  // A viewer may be gone after its tick: it closes its line then, and is destroyed by the server later.
  for (Viewer* viewer : viewers_) viewer->tick(now);
}

}  // namespace ensonify::console
