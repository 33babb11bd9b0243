// Router: commands on their way to the worlds, and their replies back. A command is sent again every second, with the
// same number, until it is answered or given up.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "clients/client/reply.h"
#include "clients/client/request.h"
#include "idl/wire/entity.h"
#include "idl/wire/owned.h"

namespace flexcast::web {

// The way to the servers.
class CommandPort {
 public:
  virtual ~CommandPort() = default;
  virtual bool may_command() const = 0;  // false: the identity may only watch
  virtual const std::string& client_id() const = 0;
  virtual bool reaches(const wire::Guid& server) = 0;  // matched both ways
  virtual wire::Result<void> write(const flexcast_Command& command) = 0;
};

class Router {
 public:
  using Clock = std::chrono::steady_clock;
  using Answer = std::function<void(const wire::Result<client::Reply>&)>;
  using FindServer = std::function<std::optional<wire::Guid>(const std::string& world)>;

  Router(CommandPort& port, FindServer find_server) : port_(port), find_server_(std::move(find_server)) {}

  // The answer comes once, from within receive(), tick() or lose(), or never if the owner is forgotten. Whoever owns
  // too many that are under way gets it at once.
  void send(const std::string& world, const client::Request& request, const void* owner, Clock::time_point now,
            Answer answer);
  void receive(const std::string& world, std::uint64_t request_id, const client::Reply& reply);
  void tick(Clock::time_point now);

  void note_life(const std::string& world, Clock::time_point now);  // it has been heard
  void lose(const std::string& world, const std::string& why);      // answers all that are under way to it
  void forget(const void* owner);

  static constexpr std::chrono::seconds resend_period{1};
  static constexpr std::chrono::seconds patience{10};
  static constexpr std::size_t most_of_an_owner = 64;

 private:
  struct Pending {
    std::string world;
    const void* owner;
    wire::Owned<flexcast_Command> command;
    Answer answer;
    bool takes_its_time = false;  // step, run_until: as long as the world lives
    bool sent = false;
    Clock::time_point next_sending, deadline;
  };
  std::size_t count(const void* owner) const;
  void try_to_send(Pending& pending, Clock::time_point now);
  void answer(std::map<std::uint64_t, Pending>::iterator pending, const wire::Result<client::Reply>& result);
  void answer_where(const std::function<bool(const Pending&)>& condition,
                    const std::function<std::string(const Pending&)>& why);

  CommandPort& port_;
  FindServer find_server_;
  std::uint64_t last_request_ = 0;
  std::map<std::uint64_t, Pending> pending_;  // by request
};

}  // namespace flexcast::web
