#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "messages/buffer.h"

/// HTTP and WebSocket on the loopback interface, by Boost.Beast: the only folder that includes it.
namespace ensonify::console {

class Doors;

/// A WebSocket as the visitor sees it.
class Line {
 public:
  virtual ~Line() = default;
  /// One binary message of these parts. The visitor's sent() follows; until then no other may be sent.
  virtual void send(const std::vector<msg::Buffer>& parts) = 0;
  /// Bytes that were sent and that the other end has not acknowledged.
  virtual std::size_t in_link() = 0;
  /// The reason is sent; the visitor is destroyed later.
  virtual void close(const std::string& why) = 0;
};

/// Who is at the other end of a line. Destroyed when the line has gone.
class Visitor {
 public:
  virtual ~Visitor() = default;
  virtual void said(std::string_view text) = 0;
  virtual void sent() = 0;
};

/// A file of the page.
struct PageFile {
  std::string_view path;  // "/app.js"
  std::string_view media_type;
  std::string_view content;
  std::string_view compressed;  // the same, by gzip
};

struct ServerOptions {
  int port = 0;  // 0: any that is free
  std::vector<PageFile> page;
};

class Server {
 public:
  static constexpr int kMostConnections = 128;
  static constexpr std::size_t kMostBytes = 64'000;  // of a message from a viewer
  static constexpr std::chrono::seconds kRequestWithin{10};

  using Enter = std::function<std::unique_ptr<Visitor>(Line&)>;  // null: there are too many

  /// Listens. Throws UserError where the port is taken.
  Server(const ServerOptions& options, Doors& doors, Enter enter);
  ~Server();

  int port() const;
  /// Serves until `tick`, which is called again and again after the time that it returns, returns a negative one.
  void run(const std::function<std::chrono::milliseconds()>& tick);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace ensonify::console
