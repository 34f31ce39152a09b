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

TEST_CASE("what is not UTF-8 is found: cut short, overlong, a surrogate, beyond the last character") {
  for (const char* text :
       {"", "plain", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x90\x9f", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    CHECK(is_utf8(text));
  }
  for (const char* text : {"b\xff", "\xc3", "\xc3x", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf0\x80\x80\xaf",
                           "\xf4\x90\x80\x80", "\x80"}) {
    CHECK_FALSE(is_utf8(text));
  }
}
