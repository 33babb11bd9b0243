#include "server/simulation_thread.h"

#include <algorithm>

namespace flexcast::server {

SimulationThread::SimulationThread(World& world, Queue<Command>& commands, Queue<Reply>& replies, FrameMailbox& mailbox,
                                   RecorderRoll* roll)
    : world_(world),
      commands_(commands),
      replies_(replies),
      mailbox_(mailbox),
      roll_(roll),
      pacer_(world.rate()),
      topology_revision_(world.topology_revision()) {
  if (roll_ != nullptr) mailbox_.on_room([&commands] { commands.wake(); });
  hand_frame_over();
  hand_on();
}

void SimulationThread::start() {
  thread_ = std::thread(&SimulationThread::run, this);
}

void SimulationThread::begin_stop() {
  stopping_ = true;
  commands_.wake();
}

void SimulationThread::stop() {
  begin_stop();
  if (thread_.joinable()) thread_.join();
}

void SimulationThread::run() {
  while (!stopping_) {
    const auto sleep = turn(Clock::now());
    if (sleep > Clock::duration::zero()) commands_.wait_for(std::min(sleep, longest_sleep));
  }
  apply_commands(Clock::now());
  world_.close();
  hand_on();
  post_status();
  stopped_ = true;
}

Clock::duration SimulationThread::turn(Clock::time_point now) {
  turned_ = now;
  mailbox_.beat();
  apply_commands(now);
  hand_frame_over();
  const bool held = is_held(now);
  hand_on();
  if (!world_.running()) {
    pacer_.restart();
    meter_.stop();
    return longest_sleep;
  }
  if (!meter_.started()) meter_.start(now, world_.simulation_state().time);
  pacer_.set_rate(world_.rate());
  const auto wait = pacer_.calc_wait(now, world_.simulation_state().time, world_.next_time());
  if (wait > Clock::duration::zero()) return wait;
  if (held) return longest_sleep;
  step();
  return Clock::duration::zero();
}

void SimulationThread::apply_commands(Clock::time_point now) {
  if (commands_.size() == 0) return;
  for (const Command& command : commands_.take_all()) {
    const auto run = world_.run_id();
    const double time = world_.simulation_state().time;
    activity_.begin_command(command.kind);
    world_.apply(command, std::max(now, Clock::now()));  // the one before may have taken long
    activity_.end();
    follow(run, time);
    hand_frame_over();
  }
}

// What a command has done to run, time and scene.
void SimulationThread::follow(std::uint64_t run, double time) {
  if (world_.topology_revision() != topology_revision_) {
    mailbox_.begin_scene(world_.simulation().model().particle_count(), world_.stream_format());
    topology_revision_ = world_.topology_revision();
    fields_.reset();
  }
  if (world_.run_id() != run) {
    pending_.reset();
    frames_skipped_ = 0;
  }
  if (world_.run_id() == run && world_.simulation_state().time == time) return;
  pacer_.restart();
  meter_.stop();
}

RecorderRoll::Position SimulationThread::position() const {
  return {world_.run_id(), world_.newest_frame(), mailbox_.capacity()};
}

// Whether lockstep forbids the next step.
bool SimulationThread::is_held(Clock::time_point now) {
  if (roll_ == nullptr) return false;
  const bool by_recorders = world_.running() && !roll_->may_step(position());
  if (!by_recorders) held_since_.reset();
  if (by_recorders && !held_since_) held_since_ = now;
  // At the end the last frame is waited for in the same way: it is sent again should it have got lost.
  mailbox_.set_held(by_recorders || (world_.is_over() && !roll_->have_all(position())));
  return by_recorders || pending_;
}

void SimulationThread::step() {
  drop_pending_frame();
  activity_.begin_step(world_.simulation_state().step + 1);
  const auto begin = Clock::now();
  world_.take_step();
  const auto end = Clock::now();
  activity_.end();
  meter_.add_step(end, world_.simulation_state().time, end - begin);
  hand_frame_over();
  world_.settle(seconds(end - begin));
  hand_on();
}

void SimulationThread::hand_frame_over() {
  if (auto header = world_.take_due_frame()) {
    drop_pending_frame();
    pending_ = header;
  }
  if (pending_ && mailbox_.push(*pending_, world_.simulation_state(), find_fields())) pending_.reset();
  handed_over_ = !pending_ && (roll_ == nullptr || world_.running() || roll_->have_all(position()));
}

// Null: the frame that waits has neither stretch nor stress.
ParticleFields* SimulationThread::find_fields() {
  if (!pending_->format.stretch && !pending_->format.stress) return nullptr;
  if (!fields_) fields_.emplace(world_.simulation().model());
  return &*fields_;
}

void SimulationThread::drop_pending_frame() {
  if (!pending_) return;
  pending_.reset();
  ++frames_skipped_;
}

void SimulationThread::hand_on() {
  mailbox_.post(world_.take_notices());
  if (mailbox_.status_wanted() || world_.state() != posted_state_ || world_.run_id() != posted_run_) post_status();
  for (Reply& reply : world_.take_replies()) replies_.push(std::move(reply));
  state_ = world_.state();
}

void SimulationThread::post_status() {
  const auto begin = Clock::now();
  WorldStatus status = world_.calc_status();
  const auto end = Clock::now();
  status.report_seconds = seconds(end - begin);
  status.real_time_factor = world_.running() ? meter_.real_time_factor(end) : 0.0;
  status.step_seconds = meter_.step_seconds();
  status.frames_skipped = frames_skipped_;
  status.command_queue = static_cast<std::uint32_t>(commands_.size());
  if (is_long_held()) {
    for (std::string& wait : roll_->calc_waits(position())) status.warnings.push_back(std::move(wait));
  }
  posted_run_ = status.run_id;
  posted_state_ = status.state;
  mailbox_.post(std::move(status));
}

}  // namespace flexcast::server
