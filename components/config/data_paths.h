#pragma once

#include <string>
#include <vector>

namespace ensonify {

/// Folders that hold the project's own launch files, scenarios and presets, best first: $ENSONIFY_SHARE, the source
/// tree that this program was built in, <prefix>/share/ensonify. Only folders that exist.
std::vector<std::string> data_roots();

/// For messages: these folders, or, where there are none, where one was searched for.
std::string data_roots_text();

/// Folder of made tiles kept from run to run unless a launch names a folder: `$XDG_CACHE_HOME/ensonify/tiles`, or
/// `~/.cache/ensonify/tiles`; "" when neither is known.
std::string tile_cache_folder();

/// The folder of the running program, where its sibling programs are.
std::string program_folder();

/// The first existing of: `path` as it is when absolute, `path` under each of `folders`, under each data root; or "".
std::string find_data(const std::string& path, const std::vector<std::string>& folders);

}  // namespace ensonify
