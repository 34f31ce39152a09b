#include "tools/topic/publish.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "components/errors/exit_error.h"

namespace ensonify::topic_tool {

namespace {

const msg::TypeInfo kType{
    "sample/1",
    "",
    {msg::field_info<bool>("on", "", ""), msg::field_info<int>("ping", "", ""),
     msg::field_info<double>("speed_mps", "m/s", ""), msg::field_info<std::string>("what", "", ""),
     msg::field_info<std::array<double, 3>>("position_enu_m", "m", ""),
     msg::field_info<std::vector<int>>("beams", "", ""), msg::field_info<msg::Array<float>>("range_m", "m", "")}};

}  // namespace

TEST_CASE("fields are read by the type's own kinds, whatever they look like") {
  const msg::Value message =
      message_of(kType, {"on=true", "ping=7", "speed_mps=2", "what='2'", "position_enu_m=[1, 2.5, -3]", "beams=[]"});
  CHECK(msg::to_json(message) ==
        R"({"on":true,"ping":7,"speed_mps":2,"what":"2","position_enu_m":[1,2.5,-3],"beams":[]})");
  CHECK(message.find("speed_mps")->as<double>() != nullptr);  // a receiver asks for a number, not an integer
}

TEST_CASE("a wrong field of a message says what is allowed") {
  const auto fault = [](const std::string& field) -> std::string {
    try {
      message_of(kType, {field});
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(fault("speed_mp=2") == "sample/1: has no field speed_mp; did you mean speed_mps?");
  CHECK(fault("ping=1.5") == "ping: is 1.5; allowed: integer");
  CHECK(fault("speed_mps=fast") == "speed_mps: is \"fast\"; allowed: number");
  CHECK(fault("position_enu_m=[1, 2]") == "position_enu_m: is [1,2]; allowed: number x 3");
  CHECK(fault("beams=[a]") == "beams.0: is \"a\"; allowed: integer");
  CHECK(fault("range_m=[1]") == "range_m: is an array, which only a program can fill (clients/python)");
  CHECK(fault("ping") == "ping: is not FIELD=VALUE");
  CHECK_THROWS_WITH(message_of(kType, {"ping=1", "ping=2"}), "ping: is given twice");
}

TEST_CASE("a publisher's sockets lie beside the clock's, by an absolute path, however the run is named") {
  CHECK(socket_folder({"", "ipc:///tmp/runs/run-a/clock", {}}) == "/tmp/runs/run-a");
  CHECK(socket_folder({"./run-a", "ipc:///tmp/runs/run-a/clock", {}}) == "/tmp/runs/run-a");
  CHECK(socket_folder({"", "ipc://run-a/clock", {}}) == (std::filesystem::current_path() / "run-a").string());
  CHECK(socket_folder({"", "tcp://127.0.0.1:5000", {}}).empty());
}

}  // namespace ensonify::topic_tool
