#include "components/formats/window.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "components/errors/assert.h"
#include "components/errors/exit_error.h"

namespace ensonify::formats {

Window::Window(const std::filesystem::path& file) {
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe without a writer must not hold us
  struct stat facts {};
  std::string cause;
  if (descriptor_ < 0 || ::fstat(descriptor_, &facts) != 0) cause = std::strerror(errno);
  else if (!S_ISREG(facts.st_mode)) cause = "it is not a regular file";
  if (!cause.empty()) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw UserError(file.string() + ": cannot be read: " + cause);
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

Window::~Window() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ByteView Window::at(std::uint64_t offset, std::size_t count) {
  if (offset >= size_) return {};
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  const bool here = offset >= begin_ && offset - begin_ + count <= memory_.size();
  if (!here) load(offset, count);
  if (offset >= size_) return {};  // it became shorter
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  return memory_.subspan(static_cast<std::size_t>(offset - begin_), count);
}

ByteView Window::peek(std::uint64_t offset, std::size_t count) {
  if (offset >= size_) return {};
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  if (offset >= begin_ && offset - begin_ + count <= memory_.size())
    return memory_.subspan(static_cast<std::size_t>(offset - begin_), count);
  ENSONIFY_ASSERT(count <= kPeek, std::to_string(count) + " bytes in a look at " + std::to_string(kPeek));
  const ssize_t got = ::pread(descriptor_, peeked_.data(), count, static_cast<off_t>(offset));
  return ByteView(peeked_).first(got > 0 ? static_cast<std::size_t>(got) : 0);
}

void Window::load(std::uint64_t offset, std::size_t count) {
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(std::max(count, kReadAhead), size_ - offset));
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  std::size_t have = 0;
  while (have < wanted) {
    const ssize_t got = ::pread(descriptor_, buffer_.data() + have, wanted - have, static_cast<off_t>(offset + have));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      error_ = got < 0 ? std::string("it cannot be read further: ") + std::strerror(errno)
                       : "it became shorter while it was read";
      size_ = offset + have;
      break;
    }
    have += static_cast<std::size_t>(got);
  }
  begin_ = offset;
  memory_ = ByteView(buffer_).first(have);
}

std::uint64_t next_byte(Window& file, std::uint64_t from, std::byte mark, std::uint64_t before) {
  constexpr std::size_t kPiece = 1U << 16U;
  for (std::uint64_t offset = from; offset < file.size();) {
    const ByteView bytes = file.at(offset, kPiece);
    if (bytes.empty()) break;
    if (const void* found = std::memchr(bytes.data(), std::to_integer<int>(mark), bytes.size())) {
      return offset + static_cast<std::uint64_t>(static_cast<const std::byte*>(found) - bytes.data()) - before;
    }
    offset += bytes.size();
  }
  return file.size();
}

}  // namespace ensonify::formats
