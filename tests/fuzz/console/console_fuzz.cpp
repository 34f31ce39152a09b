// Arbitrary texts as what a viewer says to the console: each is answered, refused or obeyed, whatever it is. One
// message a line; the first line begins with 'c' where the viewer came by the URL to control.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tools/console/console.h"
#include "tools/console/frame.h"
#include "tools/console/viewer.h"

using namespace ensonify;
using namespace ensonify::console;

namespace {

/// Takes every frame at once.
class TakingLine : public Line {
 public:
  bool waiting = false;
  bool closed = false;

  void send(const std::vector<msg::Buffer>& parts) override {
    if (waiting) std::abort();  // one at a time
    if (size_of(parts) % 8 != 0) std::abort();
    waiting = true;
  }
  std::size_t in_link() override { return 0; }
  void close(const std::string&) override { closed = true; }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  Doors doors;
  doors.set_port(1);
  Console console({}, doors);
  TakingLine line;
  const auto now = std::chrono::steady_clock::now();
  Viewer viewer(console, line, now);
  const bool controls = text.starts_with('c');
  const std::string url = controls ? doors.control_url() : doors.view_url();
  viewer.said(R"({"type": "console_enter/1", "token": ")" + url.substr(url.find('#') + 1) + "\"}");
  if (!viewer.entered()) std::abort();
  for (int second = 0; !text.empty() && !line.closed; ++second) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    viewer.said(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    for (int sent = 0; line.waiting; ++sent) {
      if (sent > 100) std::abort();  // it would never end
      line.waiting = false;
      viewer.sent();
    }
    viewer.tick(now + std::chrono::seconds(second));
  }
  return 0;
}
