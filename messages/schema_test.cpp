#include "messages/schema.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "messages/all.h"
#include "messages/envelope.h"

using namespace ensonify::msg;
namespace fs = std::filesystem;

namespace {
std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
fs::path source() { return std::getenv("ENSONIFY_SOURCE"); }
}  // namespace

TEST_CASE("every message struct is in the list of all messages") {
  std::set<std::string> written;
  const std::regex declaration(R"re(kType = "([^"]+)";)re");
  for (const auto& entry : fs::directory_iterator(source() / "messages")) {
    if (entry.path().extension() != ".h") continue;
    const std::string text = read_file(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it) written.insert((*it)[1]);
  }
  std::set<std::string> listed;
  for (const TypeInfo& type : message_types()) listed.insert(type.type);
  CHECK(written == listed);
  CHECK(listed.size() == message_types().size());
}

TEST_CASE("type names carry a major version and do not collide by hash") {
  std::set<std::uint64_t> hashes;
  for (const TypeInfo& type : message_types()) {
    CHECK(std::regex_match(type.type, std::regex("[a-z_]+/[0-9]+")));
    hashes.insert(type_hash(type.type));
  }
  CHECK(hashes.size() == message_types().size());
}

TEST_CASE("every field says what it is, and its name ends in its unit") {
  const std::regex suffix("_(ns|s|m|mps|rad|radps|rps|deg|hz|db|dbpm|upa|upa2|mps2|radps2|m2|m2ps2|rad2|degc|psu)$");
  for (const TypeInfo& type : message_types()) {
    CHECK_FALSE(type.about.empty());
    for (const FieldInfo& field : type.fields) {
      INFO(type.type << " " << field.name);
      CHECK_FALSE(field.about.empty());
      const bool counted = field.unit.empty() || field.unit == "1";
      CHECK(std::regex_search(field.name, suffix) == !counted);
    }
  }
}

TEST_CASE("the JSON Schema of a type names its fields, units and arrays") {
  CHECK(
      json_schema(find_type("health/1")) ==
      R"({"$schema":"https://json-schema.org/draft/2020-12/schema","title":"health/1",)"
      R"("description":"How a process is doing, in sim time: published when it changes. Wall-clock facts are the clock's.",)"
      R"("type":"object","properties":{)"
      R"("stamp_ns":{"description":"time of the report, sim time","unit":"ns","type":"integer"},)"
      R"("state":{"description":"ok, degraded or failed","type":"string"},)"
      R"("message":{"description":"why, in one line","type":"string"},)"
      R"("counters":{"description":"counts of what happened","type":"array","items":{"type":"object","properties":{)"
      R"("name":{"description":"name of what is counted","type":"string"},)"
      R"("count":{"description":"number of times since the start","unit":"1","type":"integer"}}}}}})");
  CHECK_THAT(json_schema(find_type("ping/1")),
             Catch::Contains(R"("type":"object","properties":{"dtype":{"const":"f4"},"shape":{"type":"array",)"));
  CHECK_THAT(json_schema(find_type("pose/1")),
             Catch::Contains(R"("type":"array","items":{"type":"number"},"minItems":3,"maxItems":3)"));
  CHECK(find_type("ping/2") == nullptr);
  CHECK(json_schema(nullptr).empty());
}

TEST_CASE("docs/manual/messages.md is what the structs say") {
  const std::string written = read_file(source() / "docs/manual/messages.md");
  const std::string generated = reference_page();
  const auto differ = std::mismatch(written.begin(), written.end(), generated.begin(), generated.end());
  INFO("renew it: ensonify describe --reference > docs/manual/messages.md");
  INFO("generated from here: " << std::string(differ.second, generated.end()).substr(0, 80));
  CHECK((written == generated));
}
