#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/formats/tide.h"
#include "kernels/base/frames/local_projection.h"

namespace ensonify::grid_tool {

/// A sounding as it is gridded.
struct Sounding {
  double x_m = 0.0, y_m = 0.0;  // in its file's map
  double depth_m = 0.0;         // positive down, from the datum of its file
  double sd_m = 0.0;            // of the depth, as stated; NaN: not stated
};

/// What a file says of all its soundings.
struct FileFacts {
  std::string file;
  std::optional<frames::Geodetic>
      origin;         // of its map, transverse Mercator about it; nothing: nobody knows where it is
  std::string datum;  // from which depths count
};

struct ReadOptions {
  std::vector<std::string> topics;    // of soundings; none: all
  bool turns = false;                 // also those of ways between lines, where the record states the mission
  std::optional<formats::Tide> tide;  // for files whose depths count from the water line
};

using TakeSounding = std::function<void(const Sounding&)>;

/// One of the files that soundings come from.
class SoundingFile {
 public:
  virtual ~SoundingFile() = default;
  virtual const FileFacts& facts() const = 0;
  /// All accepted soundings, once. Throws UserError.
  virtual void read(const TakeSounding& take) = 0;
};

/// Opens a record (.mcap, or a run's folder), a .all or a .kmall file; which it is, its content says. Throws UserError
/// for one that cannot be read or holds no soundings.
std::unique_ptr<SoundingFile> open_file(const std::string& file, const ReadOptions& options);

std::unique_ptr<SoundingFile> open_record(const std::string& file, const ReadOptions& options);
std::unique_ptr<SoundingFile> open_all(const std::string& file, const ReadOptions& options);
std::unique_ptr<SoundingFile> open_kmall(const std::string& file, const ReadOptions& options);

/// Points as another program gives them: x, y, depth and standard deviation of each, as doubles, low byte first. "-":
/// standard input. Their map is nobody's business.
std::unique_ptr<SoundingFile> open_points(const std::string& file);

}  // namespace ensonify::grid_tool
