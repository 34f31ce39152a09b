#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

struct evp_md_ctx_st;  // OpenSSL's

namespace ensonify::tiles {

/// SHA-256 of bytes that come in pieces [FIPS180-4]. Throws TileError if the cryptographic library refuses.
class Sha256 {
 public:
  Sha256();
  void add(std::span<const std::byte> bytes);
  /// Digest of all that was added, as 64 hexadecimal digits; the last call.
  std::string digest();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// Throws TileError, naming the file, if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace ensonify::tiles
