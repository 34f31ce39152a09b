#include "tools/doctor/installation.h"

#include <catch2/catch.hpp>

namespace ensonify::doctor {

TEST_CASE("the linker's trace lists libraries and what is not found") {
  const Libraries libraries = read_trace(
      "\tlinux-vdso.so.1 (0x00007f9646ebb000)\n"
      "\tlibzmq.so.5 => /lib/x86_64-linux-gnu/libzmq.so.5 (0x00007f9646cb5000)\n"
      "\tlibgdal.so.32 => not found\n"
      "\t/lib64/ld-linux-x86-64.so.2 (0x00007f9646ebd000)\n");
  CHECK(libraries == Libraries{{"libzmq.so.5", "/lib/x86_64-linux-gnu/libzmq.so.5"}, {"libgdal.so.32", ""}});
  CHECK(read_trace("not a dynamic executable\n").empty());
}

TEST_CASE("a missing library fails and names the programs that need it") {
  CHECK(judge_libraries(12, {}).text == "12, none lacks a library");
  const Finding finding = judge_libraries(2, {{"libgdal.so.32", {"ensonify-plot", "ensonify-terrain_pager"}}});
  CHECK(finding.level == Level::kFail);
  CHECK(finding.text == "libgdal.so.32 is missing for ensonify-plot, ensonify-terrain_pager");
  CHECK_FALSE(finding.advice.empty());
}

}  // namespace ensonify::doctor
