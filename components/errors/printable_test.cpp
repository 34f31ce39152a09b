#include "components/errors/printable.h"

#include <catch2/catch.hpp>

using namespace ensonify;

TEST_CASE("no control character of a file reaches the terminal") {
  CHECK(printable("a\x1b[31mred\x07\r\x7f") == "a\\x1b[31mred\\x07\\x0d\\x7f");
  CHECK(printable("a\xc2\x9b"
                  "31m") == "a\\x9b31m");  // U+009B, the one-character form of ESC [
}

TEST_CASE("text, line ends, tabs and letters of any language stay") {
  const std::string text = "Å 1.5 µPa\tº\nzwei\xc2\xa0Wörter";
  CHECK(printable(text) == text);
}
