#include "tools/console/server/server.h"

#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>

#include "components/errors/exit_error.h"
#include "tools/console/doors.h"

namespace ensonify::console {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;

// What waits does so with us, where newer messages can overtake it. (A small send buffer would do the same, and leave
// the sender to wait for delayed acknowledgements.)
constexpr int kUnsent = 16 * 1024;
constexpr std::uint32_t kMostHeader = 8 * 1024;
constexpr std::size_t kLongestReason = 120;  // a close frame holds 123 bytes

/// Nothing inline, nothing foreign, in nobody's frame.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

struct Shared {
  asio::io_context& io;
  Doors& doors;
  std::vector<PageFile> page;
  Server::Enter enter;
  int connections = 0;
};

/// Counts a connection as long as it lives.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.connections; }
  ~Counted() { --shared_.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Shared& shared_;
};

/// A WebSocket with its visitor. Kept alive by the operations under way.
class Socket : public Line, public std::enable_shared_from_this<Socket> {
 public:
  Socket(Shared& shared, beast::tcp_stream stream, std::shared_ptr<Counted> counted)
      : shared_(shared), counted_(std::move(counted)), socket_(std::move(stream)) {}

  void accept(const http::request<http::empty_body>& request) {
    auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.handshake_timeout = Server::kRequestWithin;
    timeouts.idle_timeout = std::chrono::seconds(60);
    socket_.set_option(timeouts);
    socket_.read_message_max(Server::kMostBytes);
    socket_.binary(true);
    socket_.auto_fragment(false);
    error_code ignored;
    beast::get_lowest_layer(socket_).expires_never();
    ::setsockopt(beast::get_lowest_layer(socket_).socket().native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kUnsent,
                 sizeof kUnsent);
    beast::get_lowest_layer(socket_).socket().set_option(tcp::no_delay(true), ignored);
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (!error) self->begin();
    });
  }

  void send(const std::vector<msg::Buffer>& parts) override {
    parts_ = parts;
    buffers_.clear();
    for (const msg::Buffer& part : parts_) buffers_.emplace_back(part.data, part.size);
    socket_.async_write(buffers_, [self = shared_from_this()](error_code error, std::size_t) {
      self->parts_.clear();
      if (error) return self->leave();
      if (self->closing_) return self->close_now();
      if (self->visitor_) self->visitor_->sent();
    });
  }

  std::size_t in_link() override {
    int bytes = 0;
    const int descriptor = beast::get_lowest_layer(socket_).socket().native_handle();
    return ::ioctl(descriptor, SIOCOUTQ, &bytes) == 0 && bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
  }

  void close(const std::string& why) override {
    if (closing_) return;
    closing_ = why.substr(0, kLongestReason);
    if (parts_.empty()) close_now();
  }

 private:
  void begin() {
    visitor_ = shared_.enter(*this);
    if (!visitor_) close("this console has 16 viewers, which is the most");
    read();
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->leave();
      const bool text = self->socket_.got_text();
      const std::string said = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (!text) self->close("a viewer's messages are JSON text");
      else if (self->visitor_ && !self->closing_) self->visitor_->said(said);
      self->read();
    });
  }

  void close_now() {
    socket_.async_close({websocket::close_code::policy_error, closing_->c_str()},
                        [self = shared_from_this()](error_code) { self->leave(); });
  }

  void leave() { visitor_.reset(); }

  Shared& shared_;
  std::shared_ptr<Counted> counted_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_;
  std::vector<msg::Buffer> parts_;
  std::vector<asio::const_buffer> buffers_;
  std::unique_ptr<Visitor> visitor_;
  std::optional<std::string> closing_;
};

/// A connection that makes requests, one behind the other.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Shared& shared, tcp::socket socket)
      : shared_(shared), counted_(std::make_shared<Counted>(shared)), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    stream_.expires_after(Server::kRequestWithin);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (!error) return self->respond();
      if (error == http::error::header_limit || error == http::error::bad_target || error == http::error::bad_method ||
          error == http::error::bad_version || error == http::error::bad_line_ending ||
          error == http::error::bad_field || error == http::error::bad_value)
        return self->refuse({400, "this is no HTTP request that a console answers"});
    });
  }

 private:
  void respond() {
    const auto& request = parser_->get();
    const bool upgrade = websocket::is_upgrade(request);
    const auto header = [&](http::field field) { return std::string(request[field]); };
    const std::string host = header(http::field::host);
    const std::string origin = header(http::field::origin);
    const std::string method(request.method_string());
    const std::string target(request.target());
    if (const auto refusal = shared_.doors.refusal({method, target, host, origin, upgrade})) return refuse(*refusal);
    if (parser_->content_length().value_or(0) > 0 || parser_->chunked())
      return refuse({413, "requests have no body here"});
    if (upgrade) {
      http::request<http::empty_body> plain(request.base());
      std::make_shared<Socket>(shared_, std::move(stream_), counted_)->accept(plain);
      return;
    }
    const auto file =
        std::find_if(shared_.page.begin(), shared_.page.end(), [&](const PageFile& f) { return f.path == target; });
    if (file == shared_.page.end()) return refuse({404, "there is no such file; the page is at /"});
    keep_ = request.keep_alive();
    head_ = method == "HEAD";
    const bool compressed = header(http::field::accept_encoding).find("gzip") != std::string::npos;
    write(200, file->media_type, compressed ? file->compressed : file->content, compressed);
  }

  void refuse(const Refusal& refusal) {
    keep_ = false;
    head_ = false;
    reason_ = refusal.why + "\n";
    write(refusal.status, "text/plain; charset=utf-8", reason_);
  }

  void write(int status, std::string_view media_type, std::string_view content, bool compressed = false) {
    response_.emplace();
    response_->version(11);
    response_->result(static_cast<unsigned>(status));
    response_->set(http::field::content_type, beast::string_view(media_type.data(), media_type.size()));
    if (compressed) response_->set(http::field::content_encoding, "gzip");
    response_->set("Content-Security-Policy", kPolicy);
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Referrer-Policy", "no-referrer");
    response_->set("Cross-Origin-Resource-Policy", "same-origin");
    response_->set("Cross-Origin-Opener-Policy", "same-origin");
    response_->set(http::field::cache_control, "no-store");
    response_->keep_alive(keep_);
    response_->content_length(content.size());
    if (!head_) response_->body() = {content.data(), content.size()};
    stream_.expires_after(Server::kRequestWithin);
    http::async_write(stream_, *response_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return;
      if (self->keep_) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Shared& shared_;
  std::shared_ptr<Counted> counted_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kMostHeader * 2};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<http::response<http::span_body<const char>>> response_;
  std::string reason_;
  bool keep_ = false;
  bool head_ = false;
};

}  // namespace

struct Server::Inside {
  Shared shared;  // outlives the connections that io holds
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  asio::steady_timer pause{io};

  Inside(const ServerOptions& options, Doors& doors, Enter enter)
      : shared{io, doors, options.page, std::move(enter), 0} {
    const tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<unsigned short>(options.port));
    error_code error;
    acceptor.open(here.protocol(), error);
    acceptor.set_option(asio::socket_base::reuse_address(true), error);
    acceptor.bind(here, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) throw UserError("port " + std::to_string(options.port) + ": cannot listen: " + error.message());
  }

  void accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (!error) {
        if (shared.connections < kMostConnections) std::make_shared<Connection>(shared, std::move(socket))->read();
        return accept();  // beyond the most: closed at once
      }
      if (error == asio::error::operation_aborted) return;
      pause.expires_after(std::chrono::milliseconds(100));  // no descriptor is free, for one
      pause.async_wait([this](error_code) { accept(); });
    });
  }

  void tick(const std::function<std::chrono::milliseconds()>& step) {
    const auto again = step();
    if (again.count() < 0) return io.stop();
    timer.expires_after(again);
    timer.async_wait([this, &step](error_code) { tick(step); });
  }
};

Server::Server(const ServerOptions& options, Doors& doors, Enter enter)
    : inside_(std::make_unique<Inside>(options, doors, std::move(enter))) {
  doors.set_port(port());
}
Server::~Server() = default;

int Server::port() const { return inside_->acceptor.local_endpoint().port(); }

void Server::run(const std::function<std::chrono::milliseconds()>& tick) {
  inside_->accept();
  inside_->tick(tick);
  inside_->io.run();
}

}  // namespace ensonify::console
