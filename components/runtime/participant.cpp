#include "components/runtime/participant.h"

#include <unistd.h>

#include <csignal>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/runtime/injections.h"
#include "components/runtime/termination.h"

namespace ensonify {

namespace {

constexpr std::chrono::milliseconds kWaitForData{500};  // then it hears what the clock says meanwhile

/// Once time has started the clock alone has something to say, unless it is gone.
bus::Link::Event next_event(Member& member) {
  if (member.has_run()) {
    if (auto control = member.link().wait_control()) return {bus::Link::Event::kControl, std::move(*control), {}};
  }
  return member.link().wait();
}

void take_next(Member& member) {
  const bus::Link::Event event = next_event(member);
  if (event.kind == bus::Link::Event::kClockLost) throw ExitError(kExitDied, "the clock is gone");
  if (event.kind == bus::Link::Event::kTokens) member.say_proven(event.tokens);
  else member.take(event.control);
}

int run(Member& member) {
  member.say_hello();
  while (!member.is_over()) {
    if (!member.has_grant()) {
      take_next(member);
    } else if (!member.run(kWaitForData)) {
      while (auto word = member.link().take_control()) member.take(*word);
    }
  }
  return member.exit_code();
}

}  // namespace

int participate(const OpenSession& open, const Meeting& meeting) {
  Member member(open, meeting);
  std::optional<Termination> termination;
  if (member.node().completes_files()) termination.emplace([&] { member.link().interrupt(); });
  try {
    return run(member);
  } catch (const InjectedKill& kill) {
    member.link().leave();  // the others know of all that it has published
    ::kill(::getpid(), kill.signal);
    return kExitInterrupted;  // files are completed as the node goes
  } catch (const std::exception& e) {
    if (termination && termination->asked()) return kExitInterrupted;  // files are completed as the node goes
    member.say_failed(failure_of(e));
    throw;
  }
}

}  // namespace ensonify
