#include "launch/junit.h"

#include <fmt/format.h>

namespace ensonify::launcher::junit {
namespace {

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\n': out += "&#10;"; break;
      default: out += byte < 0x20 && c != '\t' ? '?' : c;  // XML has no other control characters
    }
  }
  return out;
}

}  // namespace

std::string test_case(const std::string& suite, const std::string& name, double time_s, const std::string& failure) {
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", xml_text(suite),
                                       xml_text(name), time_s);
  return failure.empty()
             ? head + "/>\n"
             : head + fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n", xml_text(failure));
}

std::string test_suite(const std::string& name, std::size_t tests, std::size_t failures, const std::string& cases) {
  return fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n{}  </testsuite>\n", xml_text(name),
                     tests, failures, cases);
}

std::string skipped_case(const std::string& suite, const std::string& name, const std::string& why) {
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\" time=\"0.000\">\n      <skipped message=\"{}\"/>\n    </testcase>\n",
      xml_text(suite), xml_text(name), xml_text(why));
}

std::string document(const std::string& suites) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}  // namespace ensonify::launcher::junit
