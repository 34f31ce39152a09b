// The floor of the clock's grant rounds: a bare ROUTER and n DEALERs in processes of their own, a message out and one
// back per process and round, nothing else. Prints JSON with the rounds per second.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>
#include <zmq.hpp>

namespace {

void answer(const std::string& endpoint, int id, std::size_t answer_bytes) {
  zmq::context_t context(1);
  zmq::socket_t dealer(context, zmq::socket_type::dealer);
  dealer.set(zmq::sockopt::routing_id, "p" + std::to_string(id));
  dealer.set(zmq::sockopt::reconnect_ivl, 5);
  dealer.connect(endpoint);
  const std::string text(answer_bytes, 'D');
  dealer.send(zmq::buffer(text));
  zmq::message_t grant;
  while (dealer.recv(grant) && grant.size() > 0) dealer.send(zmq::buffer(text));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: bare_round PROCESSES ROUNDS GRANT_BYTES DONE_BYTES\n");
    return 2;
  }
  const int processes = std::atoi(argv[1]);
  const int rounds = std::atoi(argv[2]);
  const std::string grant(static_cast<std::size_t>(std::atoi(argv[3])), 'G');
  char folder[] = "/tmp/ensonify-bench-XXXXXX";
  if (!mkdtemp(folder)) return 2;
  const std::string endpoint = std::string("ipc://") + folder + "/round";
  for (int id = 0; id < processes; ++id) {
    if (fork() == 0) {
      answer(endpoint, id, static_cast<std::size_t>(std::atoi(argv[4])));
      std::_Exit(0);
    }
  }
  zmq::context_t context(1);
  zmq::socket_t router(context, zmq::socket_type::router);
  router.bind(endpoint);
  std::vector<zmq::message_t> ids;
  zmq::message_t id;
  zmq::message_t text;
  for (int i = 0; i < processes; ++i) {
    (void)router.recv(id);
    (void)router.recv(text);
    ids.push_back(std::move(id));
  }
  const auto send_all = [&](const std::string& what) {
    for (zmq::message_t& to : ids) {
      zmq::message_t copy;
      copy.copy(to);
      router.send(copy, zmq::send_flags::sndmore);
      router.send(zmq::buffer(what), zmq::send_flags::none);
    }
  };
  const auto begin = std::chrono::steady_clock::now();
  for (int round = 0; round < rounds; ++round) {
    send_all(grant);
    for (int i = 0; i < processes; ++i) {
      (void)router.recv(id);
      (void)router.recv(text);
    }
  }
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  send_all("");
  while (wait(nullptr) > 0) {
  }
  std::filesystem::remove_all(folder);
  std::printf("{\"rounds\": %d, \"wall_s\": %.6f, \"rounds_per_s\": %.1f}\n", rounds, wall_s, rounds / wall_s);
  return 0;
}
