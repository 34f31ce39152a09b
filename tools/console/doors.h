#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ensonify::console {

/// What a request states of where it comes from and goes to. Headers that are not there are empty.
struct Request {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  std::string_view origin;
  bool upgrade = false;  // to a WebSocket
};

/// A request that is refused: HTTP status and the line that says why.
struct Refusal {
  int status = 0;
  std::string why;
};

enum class Power { view, control };

/// Who may enter a console on the loopback interface. Another site's page in the same browser can neither read (Origin,
/// Host: a name that turns to loopback is foreign) nor guess the tokens of 128 bits, which never travel in a URL's
/// path, query or cookie.
class Doors {
 public:
  /// Draws the tokens.
  Doors();

  /// Once the port is known.
  void set_port(int port) { port_ = port; }

  /// Nothing when the request may be answered.
  std::optional<Refusal> refusal(const Request& request) const;
  /// What a token allows, or nothing.
  std::optional<Power> power_of(std::string_view token) const;

  /// The two URLs, tokens in the fragment.
  std::string view_url() const;
  std::string control_url() const;

 private:
  bool ours(std::string_view host) const;

  int port_ = 0;
  std::string view_token_;
  std::string control_token_;
};

}  // namespace ensonify::console
