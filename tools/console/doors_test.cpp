#include "tools/console/doors.h"

#include <catch2/catch.hpp>

using namespace ensonify::console;

namespace {

struct House {
  Doors doors;
  House() { doors.set_port(4711); }
  int status(const Request& request) const {
    const auto refusal = doors.refusal(request);
    return refusal ? refusal->status : 200;
  }
};

Request page(std::string_view host, std::string_view origin = "") { return {"GET", "/", host, origin, false}; }
std::string token_of(const std::string& url) { return url.substr(url.find('#') + 1); }

}  // namespace

TEST_CASE("the page is for who asks for this host, from no other origin") {
  const House house;
  CHECK(house.status(page("127.0.0.1:4711")) == 200);
  CHECK(house.status(page("localhost:4711", "http://localhost:4711")) == 200);
  CHECK(house.status(page("rebound.example:4711")) == 421);  // a name that turns to loopback
  CHECK(house.status(page("127.0.0.1")) == 421);
  CHECK(house.status(page("127.0.0.1:4712")) == 421);
  CHECK(house.status(page("")) == 421);
  CHECK(house.status(page("127.0.0.1:4711", "https://example.org")) == 403);
  CHECK(house.status(page("127.0.0.1:4711", "http://127.0.0.1:80")) == 403);
  CHECK(house.status(page("127.0.0.1:4711", "null")) == 403);
}

TEST_CASE("pages are read, never written, and the WebSocket has one place") {
  const House house;
  CHECK(house.status({"POST", "/", "localhost:4711", "", false}) == 405);
  CHECK(house.status({"GET", "/live", "localhost:4711", "", true}) == 200);
  CHECK(house.status({"GET", "/live", "localhost:4711", "", false}) == 404);
  CHECK(house.status({"GET", "/", "localhost:4711", "", true}) == 404);
  CHECK(house.status({"GET", "/live", "localhost:4711", "http://foreign.example", true}) == 403);
}

TEST_CASE("two tokens of 128 bits, and what each allows") {
  const House house;
  const std::string view = token_of(house.doors.view_url());
  const std::string control = token_of(house.doors.control_url());
  CHECK(view.size() == 32);
  CHECK(view != control);
  CHECK(token_of(House().doors.view_url()) != view);
  CHECK(house.doors.power_of(view) == Power::view);
  CHECK(house.doors.power_of(control) == Power::control);
  CHECK_FALSE(house.doors.power_of(""));
  CHECK_FALSE(house.doors.power_of(view.substr(1)));
  std::string near = control;
  near[31] = near[31] == '0' ? '1' : '0';
  CHECK_FALSE(house.doors.power_of(near));
}
