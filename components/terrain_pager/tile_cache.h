#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kernels/mesh/tile.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// Made tiles, and the chart of their seabed, kept on disk from run to run, so that the next start need not make them
/// again. A tile holds the same bits with and without. Files carry a checksum of what they hold and of which tile of
/// which seabed it is: one that is damaged, or in another's place, is made anew. All functions may be called from any
/// thread.
///
/// The folder holds a file per tile and may be deleted at any time. It keeps a budget: tiles that this run has not used
/// make room for new ones, those of other seabeds first, the least recently used first. When all that is left was used
/// by this run no more is kept, so that what a start needs stays. Each further process that writes at the same moment
/// may exceed the budget by one tile. Files that are not tiles of a cache are neither counted nor touched.
class TileCache {
 public:
  using TilePtr = std::shared_ptr<const msg::Tile>;

  /// `seabed`: all that decides what the tiles hold, as text. Nothing is written before the first tile.
  TileCache(std::filesystem::path folder, const std::string& seabed, std::uint64_t most_bytes);

  /// The tile as it was made, or nothing.
  TilePtr read(const terrain::TileKey& key);

  /// Keeps a tile if there is room. A disk that refuses, full or not to be written, is noted, and no more is kept.
  void write(const msg::Tile& tile);

  /// The same for the chart, which counts as a tile.
  std::shared_ptr<const msg::Chart> read_chart();
  void write(const msg::Chart& chart);

  /// A report to the user: a word for the log and its key=value pairs. Each is given once.
  struct Notice {
    std::string event;
    std::string pairs;
  };
  std::vector<Notice> take_notices();

  /// Of tiles.
  struct Statistics {
    std::int64_t read = 0;
    std::int64_t written = 0;
  };
  Statistics statistics() const;

 private:
  struct Kept;

  std::string name_of(const terrain::TileKey& key) const;
  std::string name_of_chart() const;
  template <class Message>
  std::shared_ptr<const Message> read_named(const std::string& name);
  template <class Message>
  void write_named(const std::string& name, const Message& message);
  std::vector<Kept> kept() const;
  bool make_room(std::uint64_t bytes) const;
  void stop_writing(const Notice& why);

  std::filesystem::path folder_;
  std::string seabed_;  // SHA-256 of its text
  std::uint64_t most_bytes_;
  std::filesystem::file_time_type begin_;  // what was used later than this belongs to a run of now
  mutable std::mutex mutex_;               // guards what follows, and room on disk
  std::set<std::string> used_;             // names of files
  bool writing_ = true;
  std::vector<Notice> notices_;
  Statistics statistics_;
};

}  // namespace ensonify::pager
