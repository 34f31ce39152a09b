// A small record for the official readers: 25 pings in 2.4 s, of which every 10th was kept, their soundings, a topic
// of a type that only a foreign program knows, one without messages.
#include <iostream>

#include "components/record/writer.h"
#include "messages/all.h"
#include "messages/codec.h"
#include "messages/schema.h"

using namespace ensonify;

namespace {

template <class M>
record::Channel channel(std::uint16_t id, const char* topic) {
  return {id, topic, M::kType, msg::json_schema(msg::find_type(M::kType)), 2, 100'000};
}

template <class M>
void write(record::RecordWriter& writer, std::uint16_t id, int n, const M& message) {
  writer.write(id, static_cast<std::uint64_t>(n), 100_ms * n, msg::encode_inline(msg::encode(message)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "Usage: write_sample_record FILE\n";
    return 2;
  }
  record::RecordWriter writer(
      argv[1], {"1.2.3", 42, 1'748'736'000'000'000'000},
      {{"launch.yaml", "application/yaml", "ensonify: launch/1\n"}, {"seed", "text/plain", "42"}});
  writer.add_channel(channel<msg::Ping>(3, "bow/ping"));
  writer.add_channel(channel<msg::Soundings>(4, "bow/soundings"));
  writer.add_channel({5, "agent/thought", "thought/1", "", 3, 100});
  writer.add_channel(channel<msg::Health>(6, "bow/health"));
  for (int n = 0; n < 25; ++n) {
    msg::Ping ping;
    ping.ping = n;
    ping.amplitude_upa = msg::Array<float>({256, 20});
    for (std::size_t i = 0; i < ping.amplitude_upa.size(); ++i) ping.amplitude_upa[i] = static_cast<float>(n) + 0.5F;
    msg::Soundings soundings;
    soundings.ping = n;
    soundings.valid = msg::Array<std::uint8_t>::of({1, 0, 1});
    if (n % 10 == 0) write(writer, 3, n, ping);
    write(writer, 4, n, soundings);
    write(writer, 5, n, msg::Guidance{n, 0.25, 2.0});
  }
  writer.close();
}
