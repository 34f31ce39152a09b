#pragma once

#include <optional>
#include <string>

#include "components/formats/xtf/file_header.h"
#include "components/logger/xtf/sidescan.h"
#include "messages/declarations.h"

namespace ensonify::logger {

/// What an XTF file of these heads begins with: two channels for each transmission of the sidescan, then one for the
/// multibeam's soundings. Offsets are the mountings as measured. Its notes say that it is simulated.
formats::xtf::FileHeader xtf_file_header(const std::string& file_name,
                                         const std::optional<msg::HeadDeclaration>& sidescan,
                                         const std::optional<msg::HeadDeclaration>& multibeam, XtfSamples samples);

}  // namespace ensonify::logger
