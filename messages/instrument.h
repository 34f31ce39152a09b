#pragma once

#include <optional>
#include <string_view>

namespace ensonify::msg {

/// Whether messages of a type hold only what an instrument, a survey system or an operator could know: no truth, and no
/// word about the simulation itself. Nothing where nobody has decided: then it is not to be shown to whom the truth is
/// withheld.
std::optional<bool> is_instrument(std::string_view type);

}  // namespace ensonify::msg
