#include "components/runtime/bus/frames.h"

#include <cstring>

namespace ensonify::bus {

namespace {

constexpr std::size_t kCopyBelow = 4096;  // a copy is cheaper than an owner

zmq::message_t frame_of(const msg::Buffer& buffer) {
  if (buffer.size < kCopyBelow) return zmq::message_t(buffer.data, buffer.size);
  auto* owner = new std::shared_ptr<const void>(buffer.owner);
  const auto release = [](void*, void* hint) { delete static_cast<std::shared_ptr<const void>*>(hint); };
  return zmq::message_t(const_cast<std::byte*>(buffer.data), buffer.size, release, owner);
}

msg::Buffer buffer_of(zmq::message_t&& frame) {
  auto kept = std::make_shared<zmq::message_t>(std::move(frame));
  const auto* data = static_cast<const std::byte*>(kept->data());
  const std::size_t size = kept->size();
  return {std::move(kept), data, size};
}

}  // namespace

std::vector<zmq::message_t> to_frames(const msg::Packet& packet) {
  std::vector<zmq::message_t> frames;
  frames.reserve(packet.envelope.frame_count);
  frames.emplace_back(packet.topic.c_str(), packet.topic.size() + 1);  // the NUL ends the topic
  const auto envelope = msg::encode_envelope(packet.envelope);
  frames.emplace_back(envelope.data(), envelope.size());
  frames.push_back(frame_of(packet.body.map));
  for (const msg::Buffer& array : packet.body.arrays) frames.push_back(frame_of(array));
  if (packet.wall_facts.size > 0) frames.push_back(frame_of(packet.wall_facts));
  return frames;
}

bool receive_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames, bool wait) {
  frames.clear();
  while (true) {
    zmq::message_t& frame = frames.emplace_back();
    const bool first = frames.size() == 1;
    if (!socket.recv(frame, wait || !first ? zmq::recv_flags::none : zmq::recv_flags::dontwait)) return false;
    if (!frame.more()) return true;
  }
}

msg::Packet to_packet(std::vector<zmq::message_t>&& frames) {
  if (frames.size() < msg::kFirstArrayFrame) throw msg::DecodeError("message: fewer than 3 frames");
  msg::Packet packet;
  packet.envelope = msg::decode_envelope({static_cast<const std::byte*>(frames[1].data()), frames[1].size()});
  if (packet.envelope.frame_count != frames.size()) throw msg::DecodeError("envelope: frame count does not match");
  const char* topic = frames[0].data<char>();
  if (frames[0].size() == 0 || topic[frames[0].size() - 1] != '\0') throw msg::DecodeError("topic: no NUL at its end");
  packet.topic.assign(topic, frames[0].size() - 1);
  packet.body.map = buffer_of(std::move(frames[2]));
  std::size_t end = frames.size();
  if ((packet.envelope.flags & msg::kFlagWallFacts) != 0 && end > msg::kFirstArrayFrame) {
    packet.wall_facts = buffer_of(std::move(frames[--end]));
  }
  for (std::size_t i = msg::kFirstArrayFrame; i < end; ++i)
    packet.body.arrays.push_back(buffer_of(std::move(frames[i])));
  return packet;
}

void send_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    zmq::message_t shared;
    shared.copy(frames[i]);
    socket.send(shared, i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
}

}  // namespace ensonify::bus
