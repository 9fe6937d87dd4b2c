#include "slam/run/frames_ahead.h"

#include <gtest/gtest.h>

#include <atomic>

#include "io/input_error.h"
#include "tests/support/fault_stream.h"

namespace slam {
namespace {

/// A stream that counts what was read of it, and cannot be read from a frame on.
class CountedStream : public FaultStream {
 public:
  CountedStream(std::vector<RecordedFrame> frames, int broken)
      : FaultStream(std::move(frames)), broken_(broken) {}
  RecordedFrame Read(int i) override {
    if (i >= broken_) throw io::InputError("depth/" + std::to_string(i) + ".png", "broken");
    ++read;
    return FaultStream::Read(i);
  }
  std::atomic<int> read = 0;

 private:
  int broken_;
};

constexpr int kStreamed = 7, kNoneBroken = kStreamed;

/// Frame 3 repeats 2 and the stamp of 5 lies before all others.
std::vector<RecordedFrame> FaultyStream() {
  std::vector<RecordedFrame> stream = CleanStream(kStreamed);
  stream[3].bgr = stream[2].bgr;
  stream[3].depth_m = stream[2].depth_m;
  stream[5].timestamp_s = 1.0;
  return stream;
}

/// By that many threads.
class FramesAheadBy : public testing::TestWithParam<int> {
 protected:
  FramesAhead Ahead(FrameSource& source, int count = kStreamed) {
    return {source, count, camera_, tracker_, GetParam()};
  }

  const Camera camera_ = CameraOfSize(320, 240);
  Tracker tracker_{camera_, Config{}, Variant::kPoints, nullptr, 0, 1};
};

TEST_P(FramesAheadBy, GivesEachFrameOnceInOrderAndExtractsWhatIsNew) {
  CountedStream stream(FaultyStream(), kNoneBroken);
  FramesAhead ahead = Ahead(stream);
  int i = 0, index = 0;
  for (; const std::optional<FrameAhead> now = ahead.Next(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(ahead.given(), i + 1);
    EXPECT_EQ(now->taken, i != 5);
    EXPECT_EQ(now->repeats, i == 3);
    EXPECT_EQ(now->frame.features.empty(), i == 3 || i == 5);
    if (i == 3 || i == 5) continue;
    EXPECT_EQ(now->frame.index, index++);
    EXPECT_NEAR(now->frame.timestamp_s, 100.0 + i / 30.0, 1e-9);
  }
  EXPECT_EQ(i, kStreamed);
  EXPECT_FALSE(ahead.Next());
  EXPECT_EQ(stream.read, kStreamed);
  EXPECT_EQ(ahead.repeats(), 1);
  EXPECT_EQ(ahead.Warnings().size(), 1u);
}

TEST_P(FramesAheadBy, BeginsNoMoreThanItIsAskedFor) {
  CountedStream stream(CleanStream(kStreamed), kNoneBroken);
  FramesAhead ahead = Ahead(stream, 2);
  EXPECT_TRUE(ahead.Next() && ahead.Next());
  EXPECT_FALSE(ahead.MayGoOn());
  EXPECT_FALSE(ahead.Next());
  EXPECT_EQ(stream.read, 2);
}

// What was begun is given all the same: a run that is stopped has the same frames by any number of
// threads.
TEST_P(FramesAheadBy, GivesOneMoreWhenItIsStopped) {
  CountedStream stream(CleanStream(kStreamed), kNoneBroken);
  FramesAhead ahead = Ahead(stream);
  ASSERT_TRUE(ahead.Next());
  EXPECT_TRUE(ahead.MayGoOn());
  ahead.Stop();
  EXPECT_FALSE(ahead.MayGoOn());
  EXPECT_TRUE(ahead.Next());
  EXPECT_FALSE(ahead.Next());
  EXPECT_EQ(stream.read, 2);
}

TEST_P(FramesAheadBy, SaysThatAFrameCannotBeReadWhenItIsThatFramesTurn) {
  CountedStream stream(CleanStream(kStreamed), 2);
  FramesAhead ahead = Ahead(stream);
  EXPECT_TRUE(ahead.Next());
  EXPECT_TRUE(ahead.Next());
  EXPECT_THROW(ahead.Next(), io::InputError);
}

TEST_P(FramesAheadBy, HasNothingOfNoFrames) {
  CountedStream stream({}, 0);
  EXPECT_FALSE(Ahead(stream, 0).Next());
}

INSTANTIATE_TEST_SUITE_P(Threads, FramesAheadBy, testing::Values(1, 2));

}  // namespace
}  // namespace slam
