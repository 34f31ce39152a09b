#pragma once

#include <memory>

#include "components/expect/check.h"

namespace ensonify::expect {

/// Compares the run with a record, message by message: time, sequence number, every byte. Throws UserError for a record
/// that lacks a topic which the expectation names.
std::unique_ptr<Check> make_same_as(const Expectation& expectation);

}  // namespace ensonify::expect
