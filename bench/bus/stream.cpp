// Latency of large messages between two processes: our link (topic, envelope, msgpack map and array; sequence and size
// checked) against bare two-frame ZeroMQ with the same socket options. The publisher stamps each message with wall time
// in its array; the subscriber notes how old it is on arrival. Prints JSON with gaps and median latency.
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>
#include <zmq.hpp>

#include "components/runtime/bus/link.h"
#include "components/runtime/bus/sockets.h"
#include "messages/codec.h"

namespace {

using ensonify::bus::Link;
using std::chrono::steady_clock;

struct Blob {
  std::int64_t stamp_ns = 0;
  ensonify::msg::Array<std::uint8_t> data;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "number of the message", self.stamp_ns);
    visit("data", "1", "wall stamp, then filler", self.data);
  }
};

struct Plan {
  bool link = true;
  std::size_t bytes = 0;
  double hz = 20;
  int count = 0;
  std::string folder;
};

std::int64_t now_ns() { return steady_clock::now().time_since_epoch().count(); }

void wait_until(std::int64_t wall_ns) {
  const timespec t{wall_ns / 1'000'000'000, wall_ns % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
}

/// Calls `send(i)` at the plan's rate.
template <class Send>
void at_rate(const Plan& plan, Send send) {
  const std::int64_t begin = now_ns() + 50'000'000;
  for (int i = 0; i < plan.count; ++i) {
    wait_until(begin + static_cast<std::int64_t>(i * 1e9 / plan.hz));
    send(i);
  }
}

std::string control_of(const Plan& plan) { return "ipc://" + plan.folder + "/nobody"; }

void publish_link(const Plan& plan) {
  Link link("pub", control_of(plan), {.run_dir = plan.folder}, 64);
  while (link.wait().kind != Link::Event::kTokens) {
  }
  at_rate(plan, [&](int i) {
    Blob blob{i, ensonify::msg::Array<std::uint8_t>({plan.bytes})};
    std::memset(blob.data.data(), i, plan.bytes);
    const std::int64_t stamp = now_ns();
    std::memcpy(blob.data.data(), &stamp, sizeof stamp);
    ensonify::msg::Packet packet;
    packet.topic = "pub/blob";
    packet.body = ensonify::msg::encode(blob);
    packet.envelope.epoch = 1;
    packet.envelope.frame_count = 4;
    packet.envelope.type_hash = ensonify::msg::type_hash("blob/1");
    packet.envelope.seq = static_cast<std::uint64_t>(i);
    packet.envelope.t_sim_ns = 1'000'000 * i;  // 1 kHz, as declared
    link.publish(packet);
  });
}

/// Age of each message on arrival; `gaps` counts missing numbers.
std::vector<std::int64_t> receive_link(const Plan& plan, int& gaps) {
  Link link("sub", control_of(plan), {.run_dir = plan.folder}, 64);
  const std::string endpoint = "ipc://" + plan.folder + "/pub.sync";
  link.subscribe({{"pub/blob", 0, "blob/1", endpoint, "t", plan.bytes + 4096, "pub", 0, {1000, 1}}}, 1);
  link.expect_until(std::chrono::hours(24));
  std::vector<std::int64_t> ages;
  std::uint64_t expected = 0;
  while (static_cast<int>(expected) < plan.count) {
    link.wait_arrived({{0, expected + 1}});
    const std::int64_t arrived = now_ns();
    for (const auto& packet : link.take()) {
      const auto blob = ensonify::msg::decode<Blob>(packet.body, plan.bytes + 4096);
      if (packet.envelope.seq != expected || blob.data[plan.bytes - 1] != static_cast<std::uint8_t>(expected)) ++gaps;
      expected = packet.envelope.seq + 1;
      std::int64_t stamp = 0;
      std::memcpy(&stamp, blob.data.data(), sizeof stamp);
      ages.push_back(arrived - stamp);
    }
  }
  return ages;
}

void publish_bare(const Plan& plan) {
  zmq::context_t context(1);
  zmq::socket_t pub(context, zmq::socket_type::xpub);
  pub.set(zmq::sockopt::sndhwm, 64);
  pub.set(zmq::sockopt::sndbuf, ensonify::bus::kKernelBuffer);
  pub.bind("ipc://" + plan.folder + "/pub.sync");
  zmq::message_t subscription;
  (void)pub.recv(subscription);
  at_rate(plan, [&](int i) {
    zmq::message_t data(plan.bytes);
    std::memset(data.data(), i, plan.bytes);
    const std::int64_t stamp = now_ns();
    std::memcpy(data.data(), &stamp, sizeof stamp);
    pub.send(zmq::str_buffer("pub/blob"), zmq::send_flags::sndmore);
    pub.send(data, zmq::send_flags::none);
  });
}

std::vector<std::int64_t> receive_bare(const Plan& plan, int& gaps) {
  zmq::context_t context(1);
  zmq::socket_t sub(context, zmq::socket_type::sub);
  sub.set(zmq::sockopt::rcvhwm, 0);
  sub.set(zmq::sockopt::rcvbuf, ensonify::bus::kKernelBuffer);
  sub.set(zmq::sockopt::subscribe, "pub/blob");
  sub.connect("ipc://" + plan.folder + "/pub.sync");
  std::vector<std::int64_t> ages;
  for (int i = 0; i < plan.count; ++i) {
    zmq::message_t topic;
    zmq::message_t data;
    (void)sub.recv(topic);
    (void)sub.recv(data);
    const std::int64_t arrived = now_ns();
    if (data.data<std::uint8_t>()[plan.bytes - 1] != static_cast<std::uint8_t>(i)) ++gaps;
    std::int64_t stamp = 0;
    std::memcpy(&stamp, data.data(), sizeof stamp);
    ages.push_back(arrived - stamp);
  }
  return ages;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: stream link|bare BYTES HZ COUNT\n");
    return 2;
  }
  char folder[] = "/tmp/ensonify-bench-XXXXXX";
  if (!mkdtemp(folder)) return 2;
  const Plan plan{std::string(argv[1]) == "link", static_cast<std::size_t>(std::atol(argv[2])), std::atof(argv[3]),
                  std::atoi(argv[4]), folder};
  const pid_t child = fork();
  if (child == 0) {
    plan.link ? publish_link(plan) : publish_bare(plan);
    std::_Exit(0);
  }
  int gaps = 0;
  std::vector<std::int64_t> ages = plan.link ? receive_link(plan, gaps) : receive_bare(plan, gaps);
  waitpid(child, nullptr, 0);
  std::filesystem::remove_all(folder);
  std::sort(ages.begin(), ages.end());
  const auto ms = [&](double q) {
    return static_cast<double>(ages[static_cast<std::size_t>(q * static_cast<double>(ages.size() - 1))]) * 1e-6;
  };
  std::printf("{\"mode\": \"%s\", \"count\": %zu, \"gaps\": %d, \"p50_ms\": %.4f, \"p99_ms\": %.4f}\n", argv[1],
              ages.size(), gaps, ms(0.5), ms(0.99));
  return gaps == 0 ? 0 : 5;
}
