#include "components/runtime/host.h"

#include <algorithm>
#include <utility>

#include "components/errors/exit_error.h"

namespace ensonify {
namespace {
constexpr std::chrono::milliseconds kWaitForData{1};  // then it hears what others say meanwhile
constexpr std::chrono::milliseconds kProveEvery{5};
}  // namespace

void Host::add(const OpenSession& open) {
  auto hosted = std::make_unique<Hosted>(*this, open, Meeting{"", address_});
  const std::string name = hosted->member.name();
  if (hosted->member.node().completes_files())
    throw UserError(name + ": has files to complete at whatever end, and so needs a process of its own");
  members_.emplace(name, std::move(hosted));
}

Host::Hosted::Hosted(Host& host, const OpenSession& open, const Meeting& meeting)
    : member(
          open, meeting,
          [this, &host](std::string_view text) {
            host.said_.push_back({member.name(), std::string(text), ""});
          },
          &host) {}

void Host::join() {
  for (const auto& [name, hosted] : members_) hosted->member.say_hello();
}

/// Whoever is outside is heard between any two grants.
std::optional<bus::ControlPlane::Message> Host::wait(std::optional<bus::WallTime> until) {
  while (true) {
    if (auto message = outside_.take()) return message;
    if (!said_.empty()) {
      Message message = std::move(said_.front());
      said_.pop_front();
      return message;
    }
    if (!words_.empty()) {
      const auto [hosted, word] = std::move(words_.front());
      words_.pop_front();
      work(*hosted, word);
    } else if (!waiting_.empty()) {
      Hosted& hosted = *waiting_.front();
      waiting_.pop_front();
      run(hosted, kWaitForData);
      if (said_.empty()) return std::nullopt;
    } else if (!started_) {
      prove();
      const auto soon = std::chrono::steady_clock::now() + kProveEvery;
      if (said_.empty()) return outside_.wait(until ? std::min(*until, soon) : soon);
    } else {
      return outside_.wait(until);
    }
  }
}

bool Host::send(const std::string& to, std::string_view text) {
  const auto hosted = members_.find(to);
  if (hosted == members_.end()) return outside_.send(to, text);
  words_.emplace_back(hosted->second.get(), text);
  return true;
}

void Host::work(Hosted& hosted, const std::string& word) {
  if (hosted.failed) return;
  try {
    hosted.member.take(word);
  } catch (const std::exception& e) {
    fail(hosted, e);
  }
  started_ |= hosted.member.has_grant();
  if (hosted.member.has_grant()) run(hosted, std::chrono::milliseconds(0));
}

void Host::run(Hosted& hosted, std::chrono::milliseconds patience) {
  try {
    if (!hosted.member.run(patience)) waiting_.push_back(&hosted);
  } catch (const std::exception& e) {
    fail(hosted, e);
  }
}

void Host::fail(Hosted& hosted, const std::exception& e) {
  hosted.failed = true;
  hosted.member.say_failed(failure_of(e));
}

/// Participants outside that have reached a member's socket.
void Host::prove() {
  for (const auto& [name, hosted] : members_) {
    if (const auto tokens = hosted->member.link().take_tokens(); !tokens.empty()) hosted->member.say_proven(tokens);
  }
}

void Host::read(const std::string& reader, const bus::Subscription& topic) {
  std::vector<Member*>& readers = readers_[topic.topic_id];
  Member* member = &members_.at(reader)->member;
  if (std::ranges::find(readers, member) == readers.end()) readers.push_back(member);
  members_.at(topic.publisher)->member.say_proven({topic.token});
}

void Host::hand_over(const msg::Packet& packet) {
  const auto readers = readers_.find(packet.envelope.topic_id);
  if (readers == readers_.end()) return;
  for (Member* reader : readers->second) reader->hand_over(packet);
}

}  // namespace ensonify
