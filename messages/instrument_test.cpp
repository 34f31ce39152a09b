#include "messages/instrument.h"

#include <catch2/catch.hpp>
#include <string>

#include "messages/schema.h"

using namespace ensonify;

TEST_CASE("of every type it is decided whether it may be shown to whom the truth is withheld") {
  for (const msg::TypeInfo& type : msg::message_types()) {
    INFO(std::string(type.type) << ": decide in messages/instrument.cpp");
    CHECK(msg::is_instrument(type.type).has_value());
  }
}

TEST_CASE("truth is no instrument's, and what nobody knows is not shown") {
  for (const char* type : {"pose/1", "tile/1", "mesh/1", "object/1", "labels/1", "health/1"})
    CHECK(msg::is_instrument(type) == false);
  for (const char* type : {"estimate/1", "soundings/1", "view/1"}) CHECK(msg::is_instrument(type) == true);
  CHECK_FALSE(msg::is_instrument("somebody/7"));
}
