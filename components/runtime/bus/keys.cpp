#include "components/runtime/bus/keys.h"

#include <fcntl.h>
#include <unistd.h>
#include <zmq.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"

namespace ensonify::bus {

namespace {

constexpr std::size_t kKeyText = 40;  // 32 bytes in Z85

std::pair<std::string, std::string> key_pair() {
  std::array<char, kKeyText + 1> known{}, secret{};
  if (zmq_curve_keypair(known.data(), secret.data()) != 0) {
    throw UserError("this ZeroMQ has no CURVE, which transport: tcp needs; allowed: transport: ipc, or keys: false");
  }
  return {known.data(), secret.data()};
}

}  // namespace

Keys Keys::make(const std::vector<std::string>& allowed) {
  Keys keys;
  std::tie(keys.bound_public, keys.bound_secret) = key_pair();
  std::tie(keys.connected_public, keys.connected_secret) = key_pair();
  keys.allowed = AddressList(allowed);
  return keys;
}

void Keys::write(const std::string& file) const {
  const std::string text = nlohmann::json{{"bound_public", bound_public},
                                          {"bound_secret", bound_secret},
                                          {"connected_public", connected_public},
                                          {"connected_secret", connected_secret},
                                          {"allowed", allowed.entries()}}
                               .dump(2) +
                           "\n";
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const bool written = fd >= 0 && ::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const std::string cause = std::strerror(errno);
  if (fd >= 0) ::close(fd);
  if (!written) throw UserError(file + ": the run's keys cannot be written: " + cause);
}

Keys Keys::read(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw UserError(file + ": the run's keys cannot be read: " + std::strerror(errno));
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  Keys keys;
  try {
    keys = {json.at("bound_public"), json.at("bound_secret"), json.at("connected_public"), json.at("connected_secret"),
            AddressList(json.at("allowed").get<std::vector<std::string>>())};
  } catch (const nlohmann::json::exception&) {
    throw UserError(file + ": holds no keys; allowed: the " + kKeysFile + " of a run directory");
  }
  for (const std::string* key :
       {&keys.bound_public, &keys.bound_secret, &keys.connected_public, &keys.connected_secret}) {
    if (key->size() != kKeyText) throw UserError(file + ": a key has not 40 characters");
  }
  return keys;
}

std::optional<Keys> keys_for(const std::string& endpoint, const std::string& file, const std::string& run_dir) {
  if (endpoint.starts_with("ipc://")) return std::nullopt;
  if (!file.empty()) return Keys::read(file);
  if (run_dir.empty()) {
    const char* named = std::getenv("ENSONIFY_KEYS");
    return named != nullptr && *named != '\0' ? std::optional(Keys::read(named)) : std::nullopt;
  }
  const std::string own = run_dir + "/" + kKeysFile;
  std::error_code error;
  return std::filesystem::exists(own, error) ? std::optional(Keys::read(own)) : std::nullopt;
}

}  // namespace ensonify::bus
