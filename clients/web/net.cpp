#include "clients/web/net.h"

#include <atomic>
#include <csignal>
#include <list>

#include "clients/web/beast_http.h"

namespace flexcast::web {
namespace {

constexpr std::chrono::milliseconds tick_period{100};
constexpr std::chrono::milliseconds accept_pause{100};  // when there are no more descriptors

wire::Result<Tcp::endpoint> resolve(asio::io_context& context, const NetOptions& options) {
  ErrorCode error;
  const auto found = Tcp::resolver(context).resolve(options.bind, std::to_string(options.port), error);
  if (error || found.empty())
    return wire::Error{"--bind " + options.bind + " is no address of this machine: " + error.message()};
  return found.begin()->endpoint();
}

wire::Result<void> open(Tcp::acceptor& acceptor, const Tcp::endpoint& endpoint) {
  ErrorCode error;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (!error) return {};
  const std::string place = endpoint.address().to_string() + ", port " + std::to_string(endpoint.port());
  const bool taken = error == asio::error::address_in_use;
  return wire::Error{
      "cannot listen on " + place + ": " + error.message() +
      (taken ? "; another program has the port: name another with --port, or --port 0 for a free one" : "")};
}

// Forgets those that are gone.
template <class T>
void tidy(std::list<std::weak_ptr<T>>& list) {
  list.remove_if([](const std::weak_ptr<T>& entry) { return entry.expired(); });
}

}  // namespace

class Net::Implementation {
 public:
  explicit Implementation(NetHandlers handlers) : handlers_(std::move(handlers)) {}

  wire::Result<void> listen(const NetOptions& options) {
    const auto endpoint = resolve(context_, options);
    if (!endpoint) return endpoint.error();
    return open(acceptor_, endpoint.value());
  }

  std::uint16_t port() const {
    ErrorCode ignored;
    return acceptor_.local_endpoint(ignored).port();
  }

  void run() {
    signals_.async_wait([this](ErrorCode error, int) {
      if (!error) end();
    });
    accept();
    tick();
    context_.run();
  }

  void wake() {
    if (wake_pending_.exchange(true)) return;
    asio::post(context_, [this] {
      wake_pending_ = false;
      handlers_.woken();
    });
  }

  void stop() {
    asio::post(context_, [this] { end(); });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](ErrorCode error, Tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (error) return accept_later();
      begin(std::move(socket));
      accept();
    });
  }

  void accept_later() {
    pause_.expires_after(accept_pause);
    pause_.async_wait([this](ErrorCode error) {
      if (!error) accept();
    });
  }

  void begin(Tcp::socket socket) {
    tidy(requests_);
    if (requests_.size() >= limits::requests) {
      if (const auto oldest = requests_.front().lock()) oldest->end();
      requests_.pop_front();
    }
    const auto keep = [this](const std::shared_ptr<BeastLine>& line) {
      tidy(lines_);
      lines_.push_back(line);
    };
    const auto request = std::make_shared<BeastHttp>(std::move(socket), handlers_, keep);
    requests_.push_back(request);
    request->read();
  }

  void tick() {
    timer_.expires_after(tick_period);
    timer_.async_wait([this](ErrorCode error) {
      if (error || ended_) return;  // one that is due is not cancelled any more
      handlers_.tick();
      tick();
    });
  }

  // What is left to do ends by itself, at the latest with the time for farewells.
  void end() {
    ended_ = true;
    ErrorCode ignored;
    acceptor_.close(ignored);
    signals_.cancel(ignored);
    timer_.cancel();
    pause_.cancel();
    for (const auto& entry : requests_)
      if (const auto request = entry.lock()) request->end();
    for (const auto& entry : lines_)
      if (const auto line = entry.lock()) line->close(CloseCode::going_away, "flexcast-web ends");
  }

  NetHandlers handlers_;
  bool ended_ = false;
  std::atomic<bool> wake_pending_ = false;
  asio::io_context context_{1};
  Tcp::acceptor acceptor_{context_};
  asio::signal_set signals_{context_, SIGINT, SIGTERM};
  asio::steady_timer timer_{context_}, pause_{context_};
  std::list<std::weak_ptr<BeastHttp>> requests_;  // the oldest first
  std::list<std::weak_ptr<BeastLine>> lines_;
};

Net::Net(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Net::~Net() = default;

wire::Result<std::unique_ptr<Net>> Net::listen(const NetOptions& options, NetHandlers handlers) {
  auto implementation = std::make_unique<Implementation>(std::move(handlers));
  if (auto listening = implementation->listen(options); !listening) return listening.error();
  return std::unique_ptr<Net>(new Net(std::move(implementation)));
}

std::uint16_t Net::port() const {
  return implementation_->port();
}

void Net::run() {
  implementation_->run();
}

void Net::wake() {
  implementation_->wake();
}

void Net::stop() {
  implementation_->stop();
}

}  // namespace flexcast::web
