// Arbitrary bytes as a record: the reader must refuse them or read what is whole.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "components/errors/exit_error.h"
#include "components/record/reader.h"
#include "messages/codec.h"

using namespace ensonify;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("record", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) return 0;
  try {
    record::RecordReader reader(path);
    for (record::RecordedMessage message; reader.next(message);) {
      try {
        msg::decode_inline(message.payload);
      } catch (const msg::DecodeError&) {
      }
    }
  } catch (const UserError&) {
  }
  return 0;
}
