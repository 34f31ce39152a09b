#include "components/logger/log_files.h"

#include "components/errors/exit_error.h"

namespace ensonify::logger {

void LogFiles::open(std::size_t format, const std::string& name) {
  if (files_.size() <= format) files_.resize(format + 1);
  files_[format] = std::make_unique<record::RecordFile>(folder_ / name, record::RecordFile::How::create);
}

void LogFiles::put(std::size_t format, const formats::Bytes& bytes) {
  record::RecordFile& file = *files_[format];
  const auto whole = file.mark();
  try {
    file.put(bytes);
  } catch (const DataLost&) {
    file.cut_to(whole);
    throw;
  }
}

void LogFiles::close(std::size_t format) { files_[format]->close(); }

std::uint64_t LogFiles::bytes(std::size_t format) const { return files_[format]->size(); }

}  // namespace ensonify::logger
