#include "tools/info/summarise.h"

#include <string_view>

#include "components/errors/exit_error.h"
#include "components/formats/recognise.h"

namespace ensonify::info {

namespace {

bool is_mcap(formats::Window& file) {
  constexpr std::string_view kMagic = "\x89MCAP0\r\n";
  const formats::ByteView begin = file.at(0, kMagic.size());
  return std::string_view(reinterpret_cast<const char*>(begin.data()), begin.size()) == kMagic;
}

}  // namespace

Summary summarise(formats::Window& file) {
  if (file.size() == 0) throw UserError("it is empty");
  switch (formats::recognise(file)) {
    case formats::Format::all: return summarise_all(file);
    case formats::Format::kmall: return summarise_kmall(file);
    case formats::Format::xtf: return summarise_xtf(file);
    case formats::Format::unknown: break;
  }
  if (!file.error().empty()) throw UserError(file.error());
  if (is_mcap(file))
    throw UserError(
        "it is an MCAP record, as ours are: ensonify compare and plot read those; this verb reads .all, .kmall and "
        "XTF");
  throw UserError("its first megabyte has no datagram of a known format; known are .all, .wcd, .kmall, .kmwcd and XTF");
}

void note_unusable(Summary& summary) {
  if (summary.extent.unusable() == 0) return;
  summary.notes.push_back("positions at latitude 0, longitude 0, or none at all: " +
                          std::to_string(summary.extent.unusable()) + "; other programs draw them where they say");
}

}  // namespace ensonify::info
