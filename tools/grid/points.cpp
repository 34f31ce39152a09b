#include <array>
#include <cstdio>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/grid/input.h"

namespace ensonify::grid_tool {
namespace {

class Points : public SoundingFile {
 public:
  explicit Points(const std::string& file)
      : stream_(file == "-" ? stdin : std::fopen(file.c_str(), "rb")), facts_{file, std::nullopt, ""} {
    if (stream_ == nullptr) throw UserError(file + ": cannot be read");
  }
  ~Points() override {
    if (stream_ != stdin) std::fclose(stream_);
  }
  Points(const Points&) = delete;
  Points& operator=(const Points&) = delete;

  const FileFacts& facts() const override { return facts_; }

  void read(const TakeSounding& take) override {
    std::array<double, std::size_t{4} * 4096> numbers;
    for (std::size_t got = 0; (got = std::fread(numbers.data(), 1, sizeof numbers, stream_)) > 0 && !interrupted();) {
      if (got % 32 != 0) throw UserError(facts_.file + ": ends within a point; allowed: points of four doubles");
      for (std::size_t i = 0; i < got / sizeof(double); i += 4)
        take({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
    }
    if (std::ferror(stream_) != 0 && !interrupted()) throw UserError(facts_.file + ": cannot be read");
  }

 private:
  std::FILE* stream_;
  FileFacts facts_;
};

}  // namespace

std::unique_ptr<SoundingFile> open_points(const std::string& file) { return std::make_unique<Points>(file); }

}  // namespace ensonify::grid_tool
