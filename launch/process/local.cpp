#include "launch/process/local.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/runtime/log.h"
#include "components/runtime/participant.h"
#include "components/runtime/stepper.h"
#include "components/runtime/tool.h"
#include "launch/process/launch_wiring.h"
#include "launch/process/run.h"

namespace ensonify {

namespace {

/// All nodes of a launch, and the bus between them: a published packet goes straight into its subscribers' queues.
class LocalRun {
 public:
  LocalRun(const Launch& launch, const std::map<std::string, NodeFactory>& components) : launch_(launch) {
    for (const ProcessSpec& process : launch.processes) {
      if (process.observer) continue;
      const auto factory = components.find(process.component);
      if (process.external || factory == components.end()) {
        throw UserError(process.name + ": only components of Ensonify can run in this process, not " +
                        (process.external            ? "an external process"
                         : process.component.empty() ? "the program " + process.argv.front()
                                                     : process.component));
      }
      members_.push_back(std::make_unique<Member>(process.name, launch.options.out));
      Member& member = *members_.back();
      member.node = factory->second(launch, process, member.ports);
      member.ports.seal();
      member.stepper.emplace(member.ports, [&member](SimTime now) { return member.node->step(now); });
      declarations_.push_back(declaration_of(process.component, member.ports));
    }
    graph_ = wire(declarations_, wire_rules(launch), process_places(launch));
    if (!graph_.problems.empty()) {
      std::string all;
      for (const std::string& problem : graph_.problems) all += (all.empty() ? "" : "\n") + problem;
      throw UserError(all);
    }
    connect();
  }

  int run() {
    Conductor conductor = make_conductor(graph_, declarations_, launch_);
    try {
      drive(conductor);
    } catch (...) {
      report(conductor);
      throw;
    }
    report(conductor);
    int code = 0;
    for (const auto& member : members_) {
      member->node->finish_run();
      if (code == 0) code = member->node->exit_code();
    }
    return code;
  }

 private:
  struct Member {
    Member(const std::string& name, const std::string& out_dir) : ports(name, out_dir) {}
    Ports ports;
    std::unique_ptr<AnyNode> node;
    std::optional<Stepper> stepper;
  };

  void drive(Conductor& conductor) {
    while (!conductor.finished()) {
      for (const Conductor::Grant& grant : conductor.grants()) {
        Stepper& stepper = *members_[grant.participant]->stepper;
        const bool finish = stepper.run_to(grant.horizon);
        if (finish) conductor.end_at(stepper.last() + kFinishMargin);
        conductor.done(grant.participant, finish ? stepper.last() + SimTime{1} : stepper.next());
      }
    }
  }

  /// What a clock would write to clock.json of such a run.
  void report(const Conductor& conductor) const {
    const SimTime reached = std::min(conductor.now(), conductor.end());
    std::ofstream(launch_.options.out + "/clock.json") << fmt::format("{{\"sim_s\": {}}}\n", seconds(reached));
  }

  void connect() {
    auto facts = facts_of(launch_);
    for (const Declaration& process : declarations_) add_notes(facts, process);
    std::vector<std::vector<Stepper*>> subscribers(graph_.topics.size());
    for (const Graph::Edge& edge : graph_.edges) {
      std::vector<Stepper*>& of_topic = subscribers[edge.topic];
      Stepper* subscriber = &*members_[edge.to]->stepper;
      if (std::find(of_topic.begin(), of_topic.end(), subscriber) == of_topic.end()) of_topic.push_back(subscriber);
    }
    for (std::size_t rank = 0; rank < members_.size(); ++rank) {
      std::vector<OutTopic> outs;
      for (std::size_t t = 0; t < graph_.topics.size(); ++t) {
        if (graph_.topics[t].publisher == rank) outs.push_back({graph_.topics[t].name, static_cast<std::uint32_t>(t)});
      }
      members_[rank]->stepper->wire(feeds_of(graph_, declarations_, rank), std::move(outs), facts, 1,
                                    static_cast<std::uint32_t>(rank), [subscribers](msg::Packet&& packet) {
                                      for (Stepper* s : subscribers[packet.envelope.topic_id]) s->insert(packet);
                                    });
    }
  }

  const Launch& launch_;
  std::vector<std::unique_ptr<Member>> members_;
  std::vector<Declaration> declarations_;
  Graph graph_;
};

}  // namespace

int run_local(const Launch& launch, const std::map<std::string, NodeFactory>& components) {
  return LocalRun(launch, components).run();
}

int local_main(int argc, char** argv, const std::map<std::string, NodeFactory>& components) {
  CLI::App app("ensonify-local: a whole launch in one process, for tests and debuggers; `ensonify run --in-process`.");
  LaunchOptions options;
  add_options(app, options, false);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  return exit_code_of([&] { return run_local(read_launch(options), components); });
}

}  // namespace ensonify
