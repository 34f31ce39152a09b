#include "tools/topic/publish.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "components/config/config_node.h"
#include "components/config/config_text.h"
#include "components/config/parse_yaml.h"
#include "components/errors/exit_error.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/clock_client.h"
#include "components/runtime/participant.h"

namespace ensonify::topic_tool {

namespace {

using msg::FieldInfo;
using msg::Value;
using nlohmann::json;

UserError unfit(const std::string& path, const FieldInfo& field, const json& given) {
  return UserError(fmt::format("{}: is {}; allowed: {}", path, given.dump(), msg::type_in_words(field)));
}

Value value_of(const FieldInfo& field, const json& given, const std::string& path);

Value list_of(const FieldInfo& field, const json& given, const std::string& path) {
  const bool fits = given.is_array() && (field.kind == FieldInfo::Kind::list || given.size() == field.length);
  if (!fits) throw unfit(path, field, given);
  Value::List list;
  for (std::size_t i = 0; i < given.size(); ++i)
    list.push_back(value_of(field.members.front(), given[i], fmt::format("{}.{}", path, i)));
  return {std::move(list)};
}

const FieldInfo& field_of(const std::vector<FieldInfo>& fields, const std::string& name, const std::string& place) {
  std::vector<std::string> known;
  for (const FieldInfo& field : fields) {
    if (field.name == name) return field;
    known.push_back(field.name);
  }
  const std::string nearest = nearest_name(name, known);
  throw UserError(fmt::format("{}: has no field {}; {}", place, name,
                              nearest.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                                              : fmt::format("did you mean {}?", nearest)));
}

Value map_of(const FieldInfo& field, const json& given, const std::string& path) {
  if (!given.is_object()) throw unfit(path, field, given);
  Value::Map map;
  for (const auto& [name, value] : given.items())
    map.emplace_back(name, value_of(field_of(field.members, name, path), value, path + "." + name));
  return {std::move(map)};
}

Value value_of(const FieldInfo& field, const json& given, const std::string& path) {
  using Kind = FieldInfo::Kind;
  switch (field.kind) {
    case Kind::boolean:
      if (given.is_boolean()) return {given.get<bool>()};
      break;
    case Kind::integer:
      if (given.is_number_integer()) return {given.get<std::int64_t>()};
      break;
    case Kind::number:
      if (given.is_number()) return {given.get<double>()};
      break;
    case Kind::text:
      if (given.is_string()) return {given.get<std::string>()};
      break;
    case Kind::fixed_list:
    case Kind::list: return list_of(field, given, path);
    case Kind::map: return map_of(field, given, path);
    case Kind::array: throw UserError(path + ": is an array, which only a program can fill (clients/python)");
  }
  throw unfit(path, field, given);
}

const msg::TypeInfo& known_type(const std::string& name) {
  std::vector<std::string> known;
  for (const msg::TypeInfo& type : msg::message_types()) {
    if (type.type == name) return type;
    known.push_back(type.type);
  }
  const std::string nearest = nearest_name(name, known);
  throw UserError(name + ": is no type of messages; " +
                  (nearest.empty() ? "`ensonify describe --reference` lists them" : "did you mean " + nearest + "?"));
}

std::pair<std::string, std::string> process_and_port(const std::string& topic) {
  const std::size_t slash = topic.find('/');
  if (slash == 0 || slash == std::string::npos || slash + 1 == topic.size())
    throw UserError(topic + ": is no topic of a participant; allowed: PROCESS/PORT, such as agent/command");
  return {topic.substr(0, slash), topic.substr(slash + 1)};
}

/// Nobody takes the part of a process that the launcher starts.
void refuse_unless_awaited(ClockClient& clock, const std::string& process) {
  const std::string fact = clock.ask({{"kind", "get"}, {"what", "external"}}).at("text");
  std::istringstream words(fact);
  const std::vector<std::string> externals{std::istream_iterator<std::string>(words), {}};
  if (std::find(externals.begin(), externals.end(), process) == externals.end()) {
    throw UserError(fmt::format(
        "{}: is no external participant of this run; {}", process,
        externals.empty() ? "its launch file declares none (`external: true`)" : fmt::format("there are {}", fact)));
  }
  const json status = clock.ask({{"kind", "status"}});
  const auto missing = status.value("missing", std::vector<std::string>{});
  if (std::find(missing.begin(), missing.end(), process) == missing.end())
    throw UserError(process + ": has joined this run already");
}

/// Publishes one message again and again.
class Publisher : public AnyNode {
 public:
  Publisher(Ports& ports, const Publication& wanted, const std::string& port, const msg::TypeInfo& type)
      : ports_(ports), due_(rate_of(wanted.rate_hz)), left_(wanted.count), endless_(wanted.count == 0) {
    message_ = message_of(type, wanted.fields);
    const auto has_stamp = [](const FieldInfo& field) { return field.name == "stamp_ns"; };
    stamped_ = std::any_of(type.fields.begin(), type.fields.end(), has_stamp) && message_.find("stamp_ns") == nullptr;
    constexpr std::size_t kRoom = 4096;  // for the rest of an envelope's map
    out_ = ports.declare_out({port, type.type, msg::encode_value(message_).size() + kRoom, rate_of(wanted.rate_hz)});
  }

  SimTime step(SimTime now) override {
    if (due_.due(now) && (endless_ || left_ > 0)) {
      if (!endless_) --left_;
      Value stamped = message_;
      if (stamped_) std::get<Value::Map>(stamped.is).emplace_back("stamp_ns", Value{now.count()});
      ports_.publish(out_, msg::encode_value(stamped));
    }
    return endless_ || left_ > 0 ? due_.next() : kNever;
  }
  void finish_run() override {}
  int exit_code() const override { return kExitOk; }

 private:
  Ports& ports_;
  Periodic due_;
  Value message_;
  bool stamped_ = false;
  std::uint64_t left_;
  bool endless_;
  std::size_t out_ = 0;
};

}  // namespace

Value message_of(const msg::TypeInfo& type, const std::vector<std::string>& assignments) {
  Value::Map map;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) throw UserError(assignment + ": is not FIELD=VALUE");
    const std::string name = assignment.substr(0, equals);
    const FieldInfo& field = field_of(type.fields, name, type.type);
    if (std::any_of(map.begin(), map.end(), [&](const auto& entry) { return entry.first == name; }))
      throw UserError(name + ": is given twice");
    const json given = json::parse(to_json(parse_config_value(assignment.substr(equals + 1), {name})));
    map.emplace_back(name, value_of(field, given, name));
  }
  return {std::move(map)};
}

std::string socket_folder(const LiveRun& run) {
  constexpr std::string_view kIpc = "ipc://";
  if (!run.endpoint.starts_with(kIpc)) return run.folder;
  return std::filesystem::absolute(run.endpoint.substr(kIpc.size())).parent_path().string();
}

int publish(const Publication& wanted) {
  const auto [process, port] = process_and_port(wanted.topic);
  const msg::TypeInfo& type = known_type(wanted.type);
  const OpenSession open = [&, process = process, port = port](const EpochOptions&) {
    return std::make_unique<Session>("topic pub", process, ".", [&](Ports& ports) {
      return std::make_unique<Publisher>(ports, wanted, port, type);
    });
  };
  const LiveRun run = find_run(wanted.run);
  ClockClient clock(run);
  refuse_unless_awaited(clock, process);
  bus::Address address;
  address.tcp = run.endpoint.starts_with("tcp://");
  address.run_dir = socket_folder(run);
  address.keys = clock.keys();
  if (address.tcp) address.host = bus::host_towards(run.endpoint);
  return participate(open, {run.endpoint, address});
}

}  // namespace ensonify::topic_tool
