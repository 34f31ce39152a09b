#include "tools/doctor/installation.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "components/config/data_paths.h"

namespace ensonify::doctor {
namespace {

namespace fs = std::filesystem;

std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// What a shell command prints; `ok` says whether it succeeded.
std::string output_of(const std::string& command, bool& ok) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ok = false;
  if (pipe == nullptr) return text;
  char part[4096];
  for (std::size_t got = 0; (got = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, got);
  const int status = ::pclose(pipe);
  ok = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return text;
}

std::vector<fs::path> programs() {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(program_folder(), ignored)) {
    const bool ours = entry.path().filename().string().starts_with("ensonify");
    if (ours && entry.is_regular_file(ignored) && ::access(entry.path().c_str(), X_OK) == 0)
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

template <class Function>
Function symbol(void* library, const char* name) {
  return reinterpret_cast<Function>(::dlsym(library, name));
}

std::string zmq_version(void* library) {
  const auto version = symbol<void (*)(int*, int*, int*)>(library, "zmq_version");
  if (version == nullptr) return "";
  int major = 0, minor = 0, patch = 0;
  version(&major, &minor, &patch);
  return dotted(major, minor, patch);
}

std::string gdal_version(void* library) {
  const auto version = symbol<const char* (*)(const char*)>(library, "GDALVersionInfo");
  return version == nullptr ? "" : version("RELEASE_NAME");
}

std::string embree_version(void* library) {
  const auto make = symbol<void* (*)(const char*)>(library, "rtcNewDevice");
  const auto property = symbol<ssize_t (*)(void*, int)>(library, "rtcGetDeviceProperty");
  const auto release = symbol<void (*)(void*)>(library, "rtcReleaseDevice");
  if (make == nullptr || property == nullptr || release == nullptr) return "";
  void* device = make("threads=1");
  if (device == nullptr) return "";
  constexpr int kVersionProperty = 0;  // RTC_DEVICE_PROPERTY_VERSION, e.g. 31305
  const auto version = static_cast<int>(property(device, kVersionProperty));
  release(device);
  return dotted(version / 10000, version / 100 % 100, version % 100);
}

/// Versions of the large libraries among those that our programs load: asked of the library itself.
Findings versions_of(const Libraries& all) {
  struct Known {
    const char* check;
    const char* prefix;
    std::string (*version)(void*);
    const char* uses;
  };
  constexpr Known kKnown[] = {{"zmq", "libzmq.so", zmq_version, "every process"},
                              {"embree", "libembree", embree_version, "the heads"},
                              {"gdal", "libgdal.so", gdal_version, "the terrain pager and ensonify plot"}};
  Findings findings;
  for (const Known& known : kKnown) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& l) { return l.first.starts_with(known.prefix); });
    if (found == all.end()) continue;  // no program beside us uses it
    void* library = ::dlopen(found->second.c_str(), RTLD_NOW | RTLD_LOCAL);
    const std::string version = library == nullptr ? "" : known.version(library);
    if (version.empty()) {
      findings.push_back({known.check, Level::kFail, found->first + " does not load",
                          std::string("it is used by ") + known.uses + "; `./dev build` installs what is missing"});
    } else {
      findings.push_back({known.check, Level::kOk, version + ", " + found->second, ""});
    }
  }
  return findings;
}

Findings check_programs() {
  std::map<std::string, std::vector<std::string>> missing;
  Libraries all;
  const std::vector<fs::path> found = programs();
  for (const fs::path& program : found) {
    bool ok = false;  // what `ldd` does
    const std::string trace = output_of("LD_TRACE_LOADED_OBJECTS=1 " + shell_quoted(program.string()) + " 2>&1", ok);
    for (const auto& [name, path] : read_trace(trace)) {
      if (path.empty()) missing[name].push_back(program.filename().string());
      else all[name] = path;
    }
  }
  Findings findings{judge_libraries(found.size(), missing)};
  for (Finding& version : versions_of(all)) findings.push_back(std::move(version));
  return findings;
}

Finding check_data() {
  const std::vector<std::string> roots = data_roots();
  if (!roots.empty()) return {"data", Level::kOk, "launch files and scenarios in " + roots.front(), ""};
  return {"data", Level::kFail, "the project's launch files and scenarios are nowhere to be found",
          "set ENSONIFY_SHARE to the folder that holds launch/ and scenarios/"};
}

Finding check_python() {
  const std::string client = find_data("clients/python", {});
  const std::string script =
      "import sys\n"
      "try:\n"
      "    import numpy, zmq, msgpack, ensonify\n"
      "except Exception as error:\n"
      "    sys.exit(print(f'{sys.executable} cannot import the client: {error}') or 1)\n"
      "print(f'{sys.executable} {sys.version.split()[0]}, client {ensonify.__version__}, numpy {numpy.__version__}, '\n"
      "      f'pyzmq {zmq.__version__}')\n";
  const std::string path = client.empty() ? "" : "PYTHONPATH=" + shell_quoted(client) + "${PYTHONPATH:+:$PYTHONPATH} ";
  bool ok = false;
  std::string stated = output_of(path + "PYTHONDONTWRITEBYTECODE=1 python3 -c " + shell_quoted(script) + " 2>&1", ok);
  while (stated.ends_with('\n')) stated.pop_back();
  if (ok) return {"python", Level::kOk, stated, ""};
  return {"python", Level::kWarn, stated,
          "`python3` of a launch file is this one; agents need python3-zmq, python3-msgpack and python3-numpy, or pip "
          "install clients/python"};
}

}  // namespace

Libraries read_trace(const std::string& trace) {
  Libraries libraries;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, arrow, path;
    if (!(words >> name >> arrow >> path) || arrow != "=>") continue;
    libraries[name] = path == "not" ? "" : path;
  }
  return libraries;
}

Finding judge_libraries(std::size_t programs, const std::map<std::string, std::vector<std::string>>& missing) {
  if (missing.empty()) return {"programs", Level::kOk, fmt::format("{}, none lacks a library", programs), ""};
  std::string text;
  for (const auto& [library, users] : missing) {
    text += fmt::format("{}{} is missing for {}", text.empty() ? "" : "; ", library, fmt::join(users, ", "));
  }
  return {"programs", Level::kFail, text,
          "`./dev build` installs what is missing, or apt install the package that holds it"};
}

Findings check_installation() {
  Findings findings = check_programs();
  findings.push_back(check_data());
  findings.push_back(check_python());
  return findings;
}

}  // namespace ensonify::doctor
