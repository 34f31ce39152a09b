#include "messages/codec.h"

#include <algorithm>
#include <bit>
#include <msgpack.hpp>
#include <optional>

namespace ensonify::msg {

namespace {

class Packer : public msgpack::packer<msgpack::sbuffer> {
 public:
  explicit Packer(msgpack::sbuffer& bytes) : msgpack::packer<msgpack::sbuffer>(bytes), bytes_(bytes) {}

  /// Always eight bytes: the library's pack_double turns 2.0 into an integer and loses the sign of -0.
  void pack_float64(double number) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    char bytes[9] = {'\xCB'};
    for (int i = 0; i < 8; ++i) bytes[1 + i] = static_cast<char>(bits >> (56 - 8 * i));
    bytes_.write(bytes, sizeof bytes);
  }

 private:
  msgpack::sbuffer& bytes_;
};

/// Where a message's arrays go: into frames behind the map, or into the map itself.
struct ArrayPlace {
  std::vector<Buffer>* frames = nullptr;
};

void pack(Packer& to, const Value& value, ArrayPlace place);

void pack_text(Packer& to, std::string_view text) {
  to.pack_str(static_cast<std::uint32_t>(text.size()));
  to.pack_str_body(text.data(), static_cast<std::uint32_t>(text.size()));
}

void pack_array(Packer& to, const RawArray& array, ArrayPlace place) {
  to.pack_map(3);
  pack_text(to, "dtype");
  pack_text(to, dtype_name(array.dtype));
  pack_text(to, "shape");
  to.pack_array(static_cast<std::uint32_t>(array.shape.size()));
  for (const std::size_t extent : array.shape) to.pack_uint64(extent);
  if (place.frames) {
    pack_text(to, "frame");
    to.pack_uint64(kFirstArrayFrame + place.frames->size());
    place.frames->push_back(array.bytes);
  } else {
    pack_text(to, "data");
    to.pack_bin(static_cast<std::uint32_t>(array.bytes.size));
    to.pack_bin_body(reinterpret_cast<const char*>(array.bytes.data), static_cast<std::uint32_t>(array.bytes.size));
  }
}

void pack(Packer& to, const Value& value, ArrayPlace place) {
  if (const auto* map = value.as<Value::Map>()) {
    to.pack_map(static_cast<std::uint32_t>(map->size()));
    for (const auto& [key, member] : *map) {
      pack_text(to, key);
      pack(to, member, place);
    }
  } else if (const auto* list = value.as<Value::List>()) {
    to.pack_array(static_cast<std::uint32_t>(list->size()));
    for (const Value& element : *list) pack(to, element, place);
  } else if (const auto* array = value.as<RawArray>()) {
    pack_array(to, *array, place);
  } else if (const auto* text = value.as<std::string>()) {
    pack_text(to, *text);
  } else if (const auto* boolean = value.as<bool>()) {
    *boolean ? to.pack_true() : to.pack_false();
  } else if (const auto* integer = value.as<std::int64_t>()) {
    to.pack_int64(*integer);
  } else if (const auto* large = value.as<std::uint64_t>()) {
    to.pack_uint64(*large);
  } else if (const auto* number = value.as<double>()) {
    to.pack_float64(*number);
  } else {
    to.pack_nil();
  }
}

/// `expected` bytes are reserved at once, so that large arrays are not moved while the buffer grows.
Buffer packed(const Value& value, ArrayPlace place, std::size_t expected = MSGPACK_SBUFFER_INIT_SIZE) {
  auto bytes = std::make_shared<msgpack::sbuffer>(expected);
  Packer packer(*bytes);
  pack(packer, value, place);
  const auto* data = reinterpret_cast<const std::byte*>(bytes->data());
  const std::size_t size = bytes->size();
  return {std::move(bytes), data, size};
}

/// Builds a Value from msgpack as it is parsed. Nothing is allocated ahead of the bytes that justify it, so a lying
/// element count costs nothing; depth is bounded here.
class Builder : public msgpack::null_visitor {
 public:
  Builder(const Buffer& source, const std::vector<Buffer>* frames)
      : source_(source), frames_(frames), frame_used_(frames ? frames->size() : 0) {}

  Value take() { return std::move(result_); }
  const std::string& error() const { return error_; }

  bool visit_nil() { return add({}); }
  bool visit_boolean(bool v) { return add({v}); }
  bool visit_positive_integer(std::uint64_t v) {
    return std::in_range<std::int64_t>(v) ? add({static_cast<std::int64_t>(v)}) : add({v});
  }
  bool visit_negative_integer(std::int64_t v) { return add({v}); }
  bool visit_float32(float v) { return add({static_cast<double>(v)}); }
  bool visit_float64(double v) { return add({v}); }
  bool visit_str(const char* v, std::uint32_t size) {
    if (expects_key_) {
      expects_key_ = false;
      open_.back().key.assign(v, size);
      return true;
    }
    return add({std::string(v, size)});
  }
  bool visit_bin(const char* v, std::uint32_t size) {
    return add({RawArray{Dtype::u8, {size}, {source_.owner, reinterpret_cast<const std::byte*>(v), size}}});
  }
  bool visit_ext(const char*, std::uint32_t) { return fail("holds a msgpack extension type"); }
  bool start_array(std::uint32_t count) { return open(with_room<Value::List>(count)); }
  bool end_array() { return close(); }
  bool start_map(std::uint32_t count) { return open(with_room<Value::Map>(count)); }
  bool start_map_key() { return expects_key_ = true; }
  bool end_map_key() { return expects_key_ ? fail("a map key is not text") : true; }
  bool end_map() { return close(); }
  void parse_error(std::size_t, std::size_t offset) { note("is not msgpack at byte " + std::to_string(offset)); }
  void insufficient_bytes(std::size_t, std::size_t offset) { note("ends early at byte " + std::to_string(offset)); }

 private:
  struct Open {
    Value value;
    std::string key;
  };

  bool fail(const std::string& what) {
    note(what);
    return false;
  }
  void note(const std::string& what) {
    if (error_.empty()) error_ = what;
  }

  /// Room for the elements announced, if they are few: more is not accepted until its bytes are there.
  template <class Container>
  static Value with_room(std::uint32_t count) {
    constexpr std::uint32_t kReserved = 16;
    Container container;
    container.reserve(std::min(count, kReserved));
    return {std::move(container)};
  }

  bool open(Value value) {
    if (expects_key_) return fail("a map key is not text");
    if (open_.size() >= kMaxDepth) return fail("is nested deeper than " + std::to_string(kMaxDepth));
    open_.push_back({std::move(value), {}});
    return true;
  }

  bool close() {
    Value value = std::move(open_.back().value);
    open_.pop_back();
    if (value.find("dtype") && (value.find("frame") || value.find("data"))) {
      std::optional<RawArray> array = described(value);
      return array && add({*std::move(array)});
    }
    return add(std::move(value));
  }

  bool add(Value value) {
    if (expects_key_) return fail("a map key is not text");
    if (++values_ > kMaxValues) return fail("has more than " + std::to_string(kMaxValues) + " values");
    if (open_.empty()) {
      result_ = std::move(value);
      return true;
    }
    Open& parent = open_.back();
    if (auto* list = std::get_if<Value::List>(&parent.value.is)) {
      list->push_back(std::move(value));
      return true;
    }
    if (parent.value.find(parent.key)) return fail(parent.key + ": stands twice");
    auto& map = std::get<Value::Map>(parent.value.is);
    if (map.size() >= kMaxKeys) return fail("has a map of more than " + std::to_string(kMaxKeys) + " keys");
    map.emplace_back(std::move(parent.key), std::move(value));
    return true;
  }

  std::optional<RawArray> described(const Value& map) {
    const auto where = [this] { return open_.empty() ? std::string("array") : open_.back().key; };
    RawArray array;
    const Value* dtype = map.find("dtype");
    const Value* shape = map.find("shape");
    if (!dtype->as<std::string>() || !dtype_from_name(*dtype->as<std::string>(), array.dtype)) {
      return note(where() + ": unknown dtype"), std::nullopt;
    }
    if (!shape || !shape->as<Value::List>() || shape->as<Value::List>()->size() > kMaxDepth) {
      return note(where() + ": has no shape"), std::nullopt;
    }
    std::size_t expected = shape->as<Value::List>()->empty() ? 0 : dtype_size(array.dtype);
    for (const Value& extent : *shape->as<Value::List>()) {
      const auto* n = extent.as<std::int64_t>();
      std::size_t product = 0;
      if (!n || *n < 0 || __builtin_mul_overflow(expected, static_cast<std::size_t>(*n), &product)) {
        return note(where() + ": bad shape"), std::nullopt;
      }
      array.shape.push_back(static_cast<std::size_t>(*n));
      expected = product;
    }
    if (!find_bytes(map, array.bytes)) return note(where() + ": has no such frame"), std::nullopt;
    if (array.bytes.size != expected) {
      return note(where() + ": shape asks for " + std::to_string(expected) + " bytes, the frame has " +
                  std::to_string(array.bytes.size)),
             std::nullopt;
    }
    return array;
  }

  bool find_bytes(const Value& map, Buffer& bytes) {
    if (!frames_) {
      const Value* data = map.find("data");
      const auto* raw = data ? data->as<RawArray>() : nullptr;
      if (raw) bytes = raw->bytes;
      return raw != nullptr;
    }
    const Value* frame = map.find("frame");
    const auto* number = frame ? frame->as<std::int64_t>() : nullptr;
    if (!number || *number < static_cast<std::int64_t>(kFirstArrayFrame)) return false;
    const auto index = static_cast<std::size_t>(*number) - kFirstArrayFrame;
    if (index >= frames_->size() || frame_used_[index]) return false;  // each frame has one owner
    frame_used_[index] = true;
    bytes = (*frames_)[index];
    return true;
  }

  const Buffer& source_;
  const std::vector<Buffer>* frames_;
  std::vector<bool> frame_used_;
  std::size_t values_ = 0;
  std::vector<Open> open_;
  Value result_;
  std::string error_;
  bool expects_key_ = false;
};

Value parse(const Buffer& map, const std::vector<Buffer>* frames) {
  Builder builder(map, frames);
  std::size_t offset = 0;
  const bool whole = map.size > 0 && msgpack::parse(reinterpret_cast<const char*>(map.data), map.size, offset, builder);
  if (!whole || !builder.error().empty()) {
    throw DecodeError("message " + (builder.error().empty() ? std::string("is empty") : builder.error()));
  }
  if (offset != map.size) throw DecodeError("message has " + std::to_string(map.size - offset) + " bytes too many");
  Value value = builder.take();
  if (!value.as<Value::Map>()) throw DecodeError("message is not a map");
  return value;
}

}  // namespace

std::size_t Body::size() const {
  std::size_t total = map.size;
  for (const Buffer& array : arrays) total += array.size;
  return total;
}

Body encode_value(const Value& message) {
  Body body;
  body.map = packed(message, {&body.arrays});
  return body;
}

Value decode_value(const Body& body, std::size_t max_bytes) {
  if (body.size() > max_bytes) {
    throw DecodeError("message has " + std::to_string(body.size()) + " bytes, at most " + std::to_string(max_bytes) +
                      " were declared");
  }
  if (body.map.size > kMaxMapBytes) throw DecodeError("message map is larger than 1 MiB");
  return parse(body.map, &body.arrays);
}

Buffer encode_inline(const Body& body) {
  constexpr std::size_t kDescriptorBytes = 64;  // more than a descriptor grows by taking its array in
  return packed(parse(body.map, &body.arrays), {}, body.size() + kDescriptorBytes * (1 + body.arrays.size()));
}

Value decode_inline(const Buffer& payload) { return parse(payload, nullptr); }

}  // namespace ensonify::msg
