#include "components/formats/km_binary/writer.h"

namespace ensonify::formats::km_binary {

Bytes write(const Sample& sample) {
  Bytes frame;
  LayoutWriter out(frame);
  out(sample);
  frame.resize(sample.stated_bytes);
  return frame;
}

}  // namespace ensonify::formats::km_binary
