#pragma once

#include <cstddef>
#include <string>

/// JUnit XML, as test systems read it.
namespace ensonify::launcher::junit {

/// A test that ended well where `failure` is empty.
std::string test_case(const std::string& suite, const std::string& name, double time_s, const std::string& failure);
std::string skipped_case(const std::string& suite, const std::string& name, const std::string& why);
std::string test_suite(const std::string& name, std::size_t tests, std::size_t failures, const std::string& cases);
std::string document(const std::string& suites);

}  // namespace ensonify::launcher::junit
