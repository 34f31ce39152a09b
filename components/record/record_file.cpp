#include "components/record/record_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "components/errors/exit_error.h"

namespace ensonify::record {

namespace {

std::string cause() { return std::strerror(errno); }

}  // namespace

RecordFile::RecordFile(std::filesystem::path path, How how) : path_(std::move(path)) {
  const bool create = how == How::create;
  if (create && path_.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(path_.parent_path(), error);
    if (error) throw UserError(path_.string() + ": cannot make its folder: " + error.message());
  }
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | (create ? O_CREAT : 0), 0644);
  if (descriptor_ < 0) throw UserError(path_.string() + ": cannot be written: " + cause());
  struct stat facts {};
  const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  const bool shrinks = ::fstat(descriptor_, &facts) == 0 && S_ISREG(facts.st_mode);
  if (locked && (!create || !shrinks || ::ftruncate(descriptor_, 0) == 0)) {
    at_.size = create ? 0 : static_cast<std::uint64_t>(facts.st_size);
    return;
  }
  const std::string why = locked ? "cannot be emptied: " + cause() : "another process is writing it";
  ::close(descriptor_);  // no destructor runs
  throw UserError(path_.string() + ": " + why);
}

RecordFile::~RecordFile() {
  if (is_open()) ::close(descriptor_);
}

void RecordFile::put(std::span<const std::byte> bytes) {
  if (!is_open()) throw DataLost(path_.string() + ": is closed");
  at_.crc = crc32(bytes, at_.crc);
  at_.size += bytes.size();
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw DataLost(path_.string() + ": cannot be written further: " + cause());
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void RecordFile::put_record(Op op, std::span<const std::byte> content) {
  ByteSink head;
  head.u8(static_cast<std::uint8_t>(op));
  head.u64(content.size());
  put(head.bytes());
  put(content);
}

void RecordFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw DataLost(path_.string() + ": cannot be read back: " + (got == 0 ? "it is shorter" : cause()));
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    at += static_cast<std::uint64_t>(got);
  }
}

void RecordFile::cut_to(Mark mark) {
  const auto size = static_cast<off_t>(mark.size);
  if (::ftruncate(descriptor_, size) != 0 || ::lseek(descriptor_, size, SEEK_SET) != size) errno = 0;
  at_ = mark;
}

void RecordFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) throw DataLost(path_.string() + ": cannot be closed: " + cause());
}

}  // namespace ensonify::record
