#pragma once

#include <string>

/// By what a cache knows that a result is still the one that would be computed now.
namespace ensonify::pager {

/// Path, size in bytes and time of the last change in ns, on a line; of a file that cannot be examined, its path
/// alone.
std::string file_identity(const std::string& path);

/// Build of this program and of its loaded libraries: a line for each, with the build ID that the
/// linker took from its contents (ELF note NT_GNU_BUILD_ID), or file_identity() where it left none. Equal lines mean
/// equal machine code, not equal processors.
std::string program_identity();

}  // namespace ensonify::pager
