// The contract time.budget, with a clock that the test makes up.
#include "core/sim/budget_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/random.h"
#include "tests/support/smooth.h"

namespace flexcast::test {
namespace {

using Assignments = std::vector<ParameterAssignment>;

// The wall time of a step with so many substeps, s.
using Cost = std::function<double(const TimeChoice&)>;

struct Driver {
  std::unique_ptr<Simulation> simulation;
  BudgetControl control = {};
  std::vector<double> seconds = {};

  void run(int steps, const Cost& cost) {
    for (int i = 0; i < steps; ++i) {
      if (!simulation->step()) throw std::runtime_error(simulation->failure()->text());
      seconds.push_back(cost(simulation->choice()));
      simulation->choose(control.follow(*simulation, seconds.back()));
    }
  }
  int substeps() const { return simulation->choice().substeps; }
};

// A frame of 20 ms.
Driver make_driver(const char* integrator, double budget) {
  return {make(smooth_scenes()[0].text(integrator, concat("budget = ", budget)))};
}

TEST(BudgetControl, TakesAsManySubstepsAsFit) {
  Driver driver = make_driver("symplectic_euler", 0.5);
  driver.run(100, [](const TimeChoice& choice) { return 1e-4 * choice.substeps; });
  EXPECT_GE(driver.substeps(), 90);
  EXPECT_LE(driver.substeps(), 100);
  EXPECT_EQ(driver.control.warning(), "");
}

TEST(BudgetControl, KeepsNinetyNineOfAHundredStepsWithinTheBudgetOnAnUnsteadyMachine) {
  Driver driver = make_driver("symplectic_euler", 0.5);
  SplitMix64 random(5);
  const auto cost = [&](const TimeChoice& choice) {
    return (2e-4 + 5e-5 * choice.substeps) * (1.0 + 0.1 * (1.0 + random.uniform()));
  };
  driver.run(40, cost);
  driver.seconds.clear();
  driver.run(400, cost);
  std::sort(driver.seconds.begin(), driver.seconds.end());
  EXPECT_LE(driver.seconds[395], 1.05 * 0.5 * 0.02);
  EXPECT_GE(driver.seconds[200], 0.7 * 0.5 * 0.02) << "time that was there is left unused";
}

TEST(BudgetControl, GivesWayWhenTheMachineBecomesSlowAndComesBack) {
  Driver driver = make_driver("symplectic_euler", 0.5);
  driver.run(60, [](const TimeChoice& choice) { return 1e-4 * choice.substeps; });
  const int before = driver.substeps();
  driver.run(60, [](const TimeChoice& choice) { return 3e-4 * choice.substeps; });
  EXPECT_LE(driver.substeps(), before / 3 + 1);
  driver.run(300, [](const TimeChoice& choice) { return 1e-4 * choice.substeps; });
  EXPECT_GE(driver.substeps(), 0.9 * before);
}

TEST(BudgetControl, ChoosesAnewSeldom) {
  Driver driver = make_driver("symplectic_euler", 0.5);
  SplitMix64 random(7);
  int changes = 0, last = 0;
  for (int i = 0; i < 600; ++i) {
    driver.run(1, [&](const TimeChoice& choice) { return 1e-4 * choice.substeps * (1.05 + 0.05 * random.uniform()); });
    changes += driver.substeps() != last;
    last = driver.substeps();
  }
  EXPECT_LE(changes, 12);
}

TEST(BudgetControl, NeverGoesBelowWhatIsStableAndSaysSo) {
  Driver driver = make_driver("symplectic_euler", 0.5);
  driver.run(60, [](const TimeChoice& choice) { return 1e-2 * choice.substeps; });
  EXPECT_GE(*driver.simulation->calc_report().stability_margin, 1.0);
  EXPECT_NE(driver.control.warning().find("time.budget"), std::string::npos);
  driver.run(200, [](const TimeChoice& choice) { return 1e-5 * choice.substeps; });
  EXPECT_EQ(driver.control.warning(), "");
}

TEST(BudgetControl, SavesIterationsWhereOneSubstepIsTooMuch) {
  Driver driver = make_driver("vbd", 0.5);
  const auto cost = [](const TimeChoice& choice) {
    return 2e-3 * choice.substeps * (choice.iterations > 0 ? choice.iterations : 10);
  };
  driver.run(100, cost);
  EXPECT_EQ(driver.simulation->choice(), (TimeChoice{1, 4}));
  EXPECT_EQ(driver.simulation->statistics().iterations, 4);
  // All of them again when there is time.
  driver.run(600, [&](const TimeChoice& choice) { return 0.1 * cost(choice); });
  EXPECT_EQ(driver.simulation->choice().iterations, 0);
}

TEST(BudgetControl, PublishesWhatItGaveUp) {
  for (const char* integrator : {"symplectic_euler", "backward_euler", "rk4", "xpbd"}) {
    Driver driver = make_driver(integrator, 0.5);
    driver.run(140, [](const TimeChoice& choice) { return 1e-3 * choice.substeps; });
    EXPECT_TRUE(driver.simulation->calc_report().error_estimate.has_value()) << integrator;
  }
}

TEST(BudgetControl, LeavesASimulationWithoutTheContractAlone) {
  Driver driver{make(smooth_scenes()[0].text("symplectic_euler", "substeps = 30"))};
  driver.run(20, [](const TimeChoice& choice) { return 1.0 * choice.substeps; });
  EXPECT_EQ(driver.simulation->choice(), (TimeChoice{30, 0}));
  driver.simulation->choose({7, 0});
  EXPECT_EQ(driver.simulation->choice(), (TimeChoice{30, 0}));
}

// What a clock chose is all that a run depends on beside the scene.
TEST(BudgetControl, ARunIsDoneAgainByItsChoices) {
  Driver driver = make_driver("backward_euler", 0.5);
  SplitMix64 random(11);
  std::vector<TimeChoice> choices;
  for (int i = 0; i < 40; ++i) {
    choices.push_back(driver.simulation->choice());
    driver.run(1, [&](const TimeChoice& choice) { return 1e-3 * choice.substeps * (2.0 + random.uniform()); });
  }
  const Driver again = make_driver("backward_euler", 0.5);
  for (const TimeChoice& choice : choices) {
    again.simulation->choose(choice);
    run(*again.simulation, 1);
  }
  EXPECT_EQ(again.simulation->calc_state_hash(), driver.simulation->calc_state_hash());
}

}  // namespace
}  // namespace flexcast::test
