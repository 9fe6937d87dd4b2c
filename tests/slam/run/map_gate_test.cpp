#include "slam/run/map_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace slam {
namespace {

TEST(MapGate, LetsOneInAtATime) {
  MapGate gate;
  constexpr int kTurns = 2000;
  int inside = 0, most = 0, turns = 0;  // guarded by the gate alone
  const auto visit = [&] {
    most = std::max(most, ++inside);
    ++turns;
    --inside;
  };
  std::thread mapping([&] {
    for (int i = 0; i < kTurns; ++i) {
      const MappingHold hold(gate);
      visit();
    }
  });
  for (int i = 0; i < kTurns; ++i) {
    const TrackingHold hold(&gate);
    visit();
  }
  mapping.join();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(turns, 2 * kTurns);
}

// Mapping that takes the map again at once would keep a camera waiting that has a frame to track. The
// scheduler may hold either thread up now and then, so most of the tries are asked for.
TEST(MapGate, LetsTrackingInBeforeMappingTakesTheMapAgain) {
  constexpr int kTries = 20;
  int tracking_first = 0;
  for (int i = 0; i < kTries; ++i) {
    MapGate gate;
    std::atomic<bool> coming = false;
    std::vector<char> order;  // guarded by the gate
    gate.EnterMapping();
    std::thread tracking([&] {
      coming = true;
      const TrackingHold hold(&gate);
      order.push_back('t');
    });
    while (!coming) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    gate.Leave();
    {
      const MappingHold again(gate);
      order.push_back('m');
    }
    tracking.join();
    tracking_first += order.front() == 't' ? 1 : 0;
  }
  EXPECT_GT(tracking_first, kTries / 2);
}

TEST(MapGate, AHoldOfNoGateKeepsNothing) {
  const TrackingHold one(nullptr), other(nullptr);
  MapGate gate;
  { const TrackingHold hold(&gate); }
  const MappingHold again(gate);  // it was given back
}

}  // namespace
}  // namespace slam
