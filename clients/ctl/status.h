// status: how a world is doing, and whether it is well.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "clients/ctl/health.h"
#include "clients/ctl/options.h"

namespace flexcast::ctl {

// Prints the newest status of the world and what is the case with it. 0: it is well, else 1.
int run_status(const Options& options, std::ostream& out, std::ostream& err);

// The worlds of a domain, as far as their statuses tell; one of them is followed.
class WorldFollower {
 public:
  // `world` "": the only one there.
  WorldFollower(wire::StatusWatch watch, std::string world) : watch_(std::move(watch)), world_(std::move(world)) {}

  // Takes what has come, and returns what is about the followed world.
  std::vector<wire::StatusNews> update();
  void wait(std::chrono::nanoseconds timeout) const { (void)watch_.wait(timeout); }

  const std::string& world() const { return world_; }
  const HealthJudge& judge() const { return judge_; }
  std::string others() const;  // names of worlds that are not followed, with commas
  // More than one, and none was named.
  bool is_ambiguous() const { return named_by_chance_ && !others_.empty(); }

 private:
  wire::StatusWatch watch_;
  std::string world_;
  HealthJudge judge_;
  std::vector<std::string> others_;
  bool named_by_chance_ = false;
};

wire::Result<wire::Participant> join(const Options& options);

// "no world 'beam' on domain 0 (profile loopback): waited 3 s; there: rope; ..."
std::string describe_absence(const Options& options, const wire::Participant& participant, const std::string& others);

}  // namespace flexcast::ctl
