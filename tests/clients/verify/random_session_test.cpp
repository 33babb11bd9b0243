// Sessions of random commands of every kind verify to the last bit.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "clients/verify/report_text.h"
#include "core/base/parallel.h"
#include "tests/clients/verify/session.h"

namespace flexcast::verify {
namespace {

using namespace server::test;
using server::CommandKind;
using test::Command;
using test::Event;
using test::Session;

// Commands that may come at any time; some of them are refused, as users' commands are.
class RandomCommands {
 public:
  explicit RandomCommands(unsigned seed) : random_(seed) {}

  Command next() {
    switch (pick(13)) {
      case 0:
        return grab(13 + pick(2), Vec3(real(-0.2, 0.8), real(-0.3, 0.3), real(0.0, 1.5)),
                    pick(2) ? 0.0 : real(1.0, 50.0));
      case 1:
        return release(13 + pick(2));
      case 2:
        return save(pick(2) ? "first" : "second");
      case 3:
      case 4:
        return restore(pick(2) ? "first" : "second");
      case 5:
        return reset(pick(2) == 1);
      case 6:
        return server::test::load_scene(pick(2) ? "pair" : "other");
      case 7:
        return pause();
      case 8:
        return step(1 + static_cast<std::uint64_t>(pick(20)));
      default:
        return set(values());
    }
  }

  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double real(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967295.0; }

 private:
  std::vector<ParameterAssignment> values() {
    const std::vector<std::string> schemes = {
        "symplectic_euler", "velocity_verlet", "rk4", "backward_euler", "bdf2", "xpbd", "vbd"};
    switch (pick(9)) {
      case 0:
        return {{"gravity", Vec3(real(-3, 3), 0.0, real(-10, 0))}};
      case 1:
        return {{"rope.stiffness", real(5, 40)}, {"beam.young", real(5e4, 2e5)}};
      case 2:
        return {{"time.integrator", schemes[static_cast<std::size_t>(pick(static_cast<int>(schemes.size())))]}};
      case 3:
        return {{"time.step", real(5e-4, 1e-3)}, {"server.rate", real(0.0, 2.0)}};
      case 4:
        return {{"time.tolerance", pick(2) ? real(1e-3, 1e-2) : 0.0}, {"time.budget", 0.0}, {"rope.stiffness", 20.0}};
      case 5:
        return {{"time.budget", pick(2) ? real(0.01, 0.1) : 0.0}, {"time.tolerance", 0.0}, {"rope.stiffness", 20.0}};
      case 6:
        return {{"stream.every", std::int64_t{1 + pick(3)}}};
      case 7:
        // Fails within three steps. A contract would take millions of substeps.
        return {{"rope.stiffness", 1e200},
                {"time.integrator", std::string("symplectic_euler")},
                {"time.tolerance", 0.0},
                {"time.budget", 0.0}};
      default:
        return {{"time.substeps", std::int64_t{1 + pick(3)}}, {"rope.damping", real(0.0, 0.05)}};
    }
  }

  std::mt19937 random_;
};

std::set<CommandKind> kinds_of(const Session& session) {
  std::set<CommandKind> kinds;
  for (const Event& event : session.events) {
    if (event.kind == server::EventKind::command) kinds.insert(event.command);
  }
  return kinds;
}

// What a failed world needs to go on.
Command mend() {
  return set({{"rope.stiffness", 20.0}});
}

// So many commands that change something, and steps between them.
int play(Session& session, unsigned seed, int commands, int steps) {
  RandomCommands random(seed);
  int taken = 0, applied = 0;
  for (int tries = 0; applied < commands && tries < 20 * commands; ++tries) {
    if (session.apply(random.next()).outcome == server::Outcome::applied) ++applied;
    taken += session.run(5 + random.pick(2 * steps / commands), random.real(1e-6, 1e-5));
    if (session->state() == server::WorldState::failed) {
      // What is left of the state may be at the end of all numbers.
      session.apply(mend());
      session.apply(resume());
      taken += session.run(2);
      session.apply(reset(random.pick(2) == 1));
    }
    if (!session->running()) session.apply(random.pick(2) ? resume() : step(5));
  }
  for (int tries = 0; taken < steps && tries < steps; ++tries) {
    if (!session->running()) {
      session.apply(reset());
      session.apply(resume());
    }
    taken += session.run(std::min(100, steps - taken));
  }
  return applied;
}

TEST(RandomSessions, TenThousandStepsWithFiftyCommandsVerifyWithOneThreadAndWithTwo) {
  Session session(test::pair_scene());
  session.apply(grab(13, Vec3(0.3, 0.2, 1.2)));
  session.run(20);
  session.apply(release(13));
  EXPECT_EQ(play(session, 1, 48, 10'000), 48);
  for (const CommandKind kind :
       {CommandKind::set, CommandKind::reset, CommandKind::pause, CommandKind::resume, CommandKind::step,
        CommandKind::load, CommandKind::save, CommandKind::restore, CommandKind::grab, CommandKind::release}) {
    EXPECT_TRUE(kinds_of(session).contains(kind)) << static_cast<int>(kind);
  }
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    const auto report = session.verify();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_TRUE(report.value().verified()) << threads << " threads\n" << to_text(report.value());
  }
  set_thread_count(1);
}

TEST(RandomSessions, OtherSeedsVerify) {
  const unsigned last = std::getenv("FLEXCAST_LONG") ? 100 : 8;
  for (unsigned seed = 2; seed <= last; ++seed) {
    Session session(test::pair_scene());
    play(session, seed, 20, 300);
    const auto report = session.verify();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_TRUE(report.value().verified()) << "seed " << seed << "\n" << to_text(report.value());
  }
}

}  // namespace
}  // namespace flexcast::verify
