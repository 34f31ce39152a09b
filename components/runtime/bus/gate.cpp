#include "components/runtime/bus/gate.h"

#include <array>
#include <csignal>

namespace ensonify::bus {

namespace {

std::string bytes_of(const std::string& text) {
  std::array<std::uint8_t, 32> bytes{};
  zmq_z85_decode(bytes.data(), text.c_str());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Gate::Gate(zmq::context_t& context, const Keys& keys, Refused refused)
    : key_(bytes_of(keys.connected_public)),
      allowed_(keys.allowed),
      refused_(std::move(refused)),
      end_(context, zmq::socket_type::pair) {
  zmq::socket_t questions(context, zmq::socket_type::rep);
  zmq::socket_t ended(context, zmq::socket_type::pair);
  questions.set(zmq::sockopt::linger, 0);
  questions.bind("inproc://zeromq.zap.01");
  ended.bind("inproc://gate-ends");
  end_.connect("inproc://gate-ends");
  sigset_t all, before;  // signals are for the other threads, as with ZeroMQ's own
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this, asked = std::move(questions), over = std::move(ended)]() mutable {
    zmq::pollitem_t items[] = {{asked.handle(), 0, ZMQ_POLLIN, 0}, {over.handle(), 0, ZMQ_POLLIN, 0}};
    try {
      while (zmq::poll(items, 2, std::chrono::milliseconds(-1)) > 0 && items[1].revents == 0) answer(asked);
    } catch (const zmq::error_t&) {  // the context ends
    }
  });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Gate::~Gate() {
  try {
    end_.send(zmq::str_buffer("end"), zmq::send_flags::dontwait);
  } catch (const zmq::error_t&) {  // the context has ended, and the thread with it
  }
  thread_.join();
}

void Gate::answer(zmq::socket_t& socket) {
  std::array<std::string, 8> question;  // version, id, domain, address, identity, mechanism, key
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    zmq::message_t frame;
    if (!socket.recv(frame)) return;
    if (count < question.size()) question[count] = frame.to_string();
    more = frame.more();
  }
  const std::string& address = question[3];
  const bool has_key = count == 7 && question[5] == "CURVE" && question[6] == key_;
  const bool is_allowed = allowed_.contains(address);
  const char* why = !has_key ? "it has another key" : !is_allowed ? "its address is not allowed" : "";
  if (*why != '\0' && refused_) refused_(address, why);
  const std::string status = *why == '\0' ? "200" : "400";
  for (const std::string& frame : {std::string("1.0"), question[1], status, std::string(why), std::string()}) {
    socket.send(zmq::buffer(frame), zmq::send_flags::sndmore);
  }
  socket.send(zmq::message_t(), zmq::send_flags::none);
}

void set_bound(zmq::socket_t& socket, const Keys& keys) {
  socket.set(zmq::sockopt::curve_server, true);
  socket.set(zmq::sockopt::curve_secretkey, keys.bound_secret);
}

void set_connected(zmq::socket_t& socket, const Keys& keys) {
  socket.set(zmq::sockopt::curve_serverkey, keys.bound_public);
  socket.set(zmq::sockopt::curve_publickey, keys.connected_public);
  socket.set(zmq::sockopt::curve_secretkey, keys.connected_secret);
}

}  // namespace ensonify::bus
