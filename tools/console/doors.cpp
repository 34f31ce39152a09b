#include "tools/console/doors.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cstdint>
#include <stdexcept>

namespace ensonify::console {

namespace {

std::string drawn_token() {
  std::array<std::uint8_t, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("getrandom: no random numbers for the console's tokens");
  std::string token;
  for (const std::uint8_t byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

/// Takes as long for any wrong token of the right length.
bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

}  // namespace

Doors::Doors() : view_token_(drawn_token()), control_token_(drawn_token()) {}

bool Doors::ours(std::string_view host) const {
  return host == fmt::format("127.0.0.1:{}", port_) || host == fmt::format("localhost:{}", port_);
}

std::optional<Refusal> Doors::refusal(const Request& request) const {
  if (!ours(request.host))
    return Refusal{421, fmt::format("this console answers as 127.0.0.1:{0} and localhost:{0} only", port_)};
  constexpr std::string_view kScheme = "http://";
  if (!request.origin.empty() && (!request.origin.starts_with(kScheme) || !ours(request.origin.substr(kScheme.size()))))
    return Refusal{403, "pages of another origin have no access"};
  if (request.method != "GET" && request.method != "HEAD") return Refusal{405, "allowed: GET, HEAD"};
  if (request.upgrade != (request.target == "/live"))
    return Refusal{404, "a WebSocket is at /live, and nothing else is there"};
  return std::nullopt;
}

std::optional<Power> Doors::power_of(std::string_view token) const {
  if (same_token(token, view_token_)) return Power::view;
  if (same_token(token, control_token_)) return Power::control;
  return std::nullopt;
}

std::string Doors::view_url() const { return fmt::format("http://127.0.0.1:{}/#{}", port_, view_token_); }
std::string Doors::control_url() const { return fmt::format("http://127.0.0.1:{}/#{}", port_, control_token_); }

}  // namespace ensonify::console
