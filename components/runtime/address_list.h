#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify {

/// An IPv4 address in figures.
bool is_address(const std::string& text);

/// Addresses that may connect: "10.0.0.2", or a network "10.0.0.0/24" (IPv4).
class AddressList {
 public:
  AddressList() = default;
  /// Throws UserError for what is neither.
  explicit AddressList(const std::vector<std::string>& entries);
  bool contains(const std::string& address) const;
  const std::vector<std::string>& entries() const { return entries_; }

 private:
  struct Network {
    std::uint32_t bits = 0;
    std::uint32_t mask = 0;
  };
  std::vector<std::string> entries_;
  std::vector<Network> networks_;
};

}  // namespace ensonify
