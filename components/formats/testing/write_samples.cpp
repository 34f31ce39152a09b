// Writes the made-up files of sample.h into a folder: sample.all, sample.kmall, sample.xtf.   write_sample_formats
// FOLDER
#include <cstdio>
#include <fstream>

#include "components/formats/testing/sample.h"

int main(int argc, char** argv) {
  using namespace ensonify::formats;
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_sample_formats FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  const auto write = [&](const char* name, const sample::File& file) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(file.bytes.data()), static_cast<std::streamsize>(file.bytes.size()));
  };
  write("sample.all", sample::all_file());
  write("sample.kmall", sample::kmall_file());
  write("sample.xtf", sample::xtf_file());
}
