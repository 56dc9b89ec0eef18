// What happens when the image library crashes, hangs or is killed: the file is refused, and the next one is
// read.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include "renderer/core/error.h"
#include "renderer/scene/codec_client.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/picture.h"
#include "tests/support/lying_png.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr PixelLimits kLimits{kMaxImageSize, kMaxImageSize, 4, kMaxImageBytes};

std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(parent) + "/task")) {
        std::ifstream list(task.path() / "children");
        for (pid_t child; list >> child;) {
            // One that has ended and was not waited for yet has no program.
            std::error_code error;
            if (!fs::read_symlink("/proc/" + std::to_string(child) + "/exe", error).empty())
                children.push_back(child);
        }
    }
    return children;
}

pid_t codecProcess() {
    for (const pid_t child : childrenOf(::getpid())) {
        std::string name;
        std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
        if (name == "cutis-codec") return child;
    }
    return 0;
}

// The processes that work for the codec once there are some, or none.
std::vector<pid_t> awaitWorkers(bool some) {
    for (int i = 0; i < 1000; ++i, std::this_thread::sleep_for(10ms)) {
        const pid_t codec = codecProcess();
        const std::vector<pid_t> workers = codec ? childrenOf(codec) : std::vector<pid_t>();
        if (workers.empty() != some) return workers;
    }
    ADD_FAILURE() << (some ? "no process works on the image" : "a process works on without end");
    return {};
}

std::vector<std::byte> smallPng() {
    Image image;
    image.width = image.height = 2;
    image.texels.assign(16, std::byte(255));
    return encodePng(image);
}

void expectWorks(const std::vector<std::byte>& png) {
    const CodecResult result = decodeImageMemory(png, kLimits);
    EXPECT_EQ(result.why, "");
    EXPECT_EQ(result.layout.width, 2);
    EXPECT_EQ(result.data.bytes().size(), result.layout.bytes());
}

// A pipe into which nobody writes: whoever opens it waits.
class WorkerEnds : public testing::TestWithParam<std::pair<int, const char*>> {};

TEST_P(WorkerEnds, TheFileIsRefusedAndTheNextIsRead) {
    const auto& [signal, why] = GetParam();
    const std::vector<std::byte> png = smallPng();
    const test::TemporaryFolder folder;
    const std::string pipe = (folder / "waits.png").string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    awaitWorkers(false);  // the one that made the PNG
    auto refused = std::async(std::launch::async, [&] { return decodeImageFile(pipe, kLimits); });
    for (const pid_t worker : awaitWorkers(true)) ::kill(worker, signal);
    const CodecResult result = refused.get();
    EXPECT_NE(result.why.find(why), std::string::npos) << result.why;
    EXPECT_TRUE(result.data.empty());
    expectWorks(png);
}

INSTANTIATE_TEST_SUITE_P(Codec, WorkerEnds,
                         testing::Values(std::pair{SIGSEGV, "its decoder crashed (Segmentation fault)"},
                                         std::pair{SIGABRT, "its decoder crashed (Aborted)"},
                                         std::pair{SIGALRM, "too long"}, std::pair{SIGXCPU, "too long"},
                                         std::pair{SIGKILL, "too much time or memory"}));

TEST(Codec, StartsAgainWhenItWasKilled) {
    const std::vector<std::byte> png = smallPng();
    const pid_t codec = codecProcess();
    ASSERT_NE(codec, 0);
    ::kill(codec, SIGKILL);
    std::this_thread::sleep_for(50ms);
    expectWorks(png);
    EXPECT_NE(codecProcess(), codec);
}

// The program under tests/support/bad_decoder.cpp, for the time that this lives.
class BadDecoder {
  public:
    explicit BadDecoder(const char* kind) {
        ::setenv("LD_PRELOAD", CUTIS_BAD_DECODER_LIBRARY, 1);
        ::setenv("CUTIS_BAD_DECODER", kind, 1);
        endCodec();
    }
    ~BadDecoder() {
        ::unsetenv("LD_PRELOAD");
        ::unsetenv("CUTIS_BAD_DECODER");
        endCodec();
    }

  private:
    static void endCodec() {
        if (const pid_t codec = codecProcess()) ::kill(codec, SIGKILL);
        std::this_thread::sleep_for(50ms);
    }
};

// Of processor time that a process has taken so far, or nothing when it is gone (proc(5), stat).
std::optional<double> secondsOf(pid_t process) {
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string field;
    for (int i = 1; i <= 13; ++i) stat >> field;
    double user = 0, system = 0;
    if (!(stat >> user >> system)) return {};
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

// Its file claims a gigabyte of samples, which gives it no time.
TEST(Codec, ADecoderThatSpinsIsEndedWithinFiveSeconds) {
    const std::vector<std::byte> png = smallPng();
    {
        const BadDecoder bad("spin");
        const std::string file = test::lyingPng(16384, 8);
        auto refused = std::async(std::launch::async, [&] {
            return decodeImageMemory(std::as_bytes(std::span(file)), kLimits);
        });
        const std::vector<pid_t> workers = awaitWorkers(true);
        ASSERT_EQ(workers.size(), 1u);
        double seconds = 0;
        while (const std::optional<double> now = secondsOf(workers[0])) {
            seconds = *now;
            std::this_thread::sleep_for(10ms);
        }
        EXPECT_GT(seconds, 3) << "it did not spin";
        EXPECT_LT(seconds, 5);
        EXPECT_NE(refused.get().why.find("too long"), std::string::npos);
    }
    expectWorks(png);
}

TEST(Codec, ADecoderThatCrashesIsRefused) {
    const std::vector<std::byte> png = smallPng();
    {
        const BadDecoder bad("crash");
        const CodecResult result = decodeImageMemory(png, kLimits);
        EXPECT_EQ(result.why, "its decoder crashed (Segmentation fault)");
    }
    expectWorks(png);
}

TEST(Codec, OneThatCannotStartIsSaidAndLeavesNothingOpen) {
    const std::vector<std::byte> png = smallPng();
    const auto open = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    {
        const BadDecoder bad("end");
        EXPECT_EQ(decodeImageMemory(png, kLimits).why, "the image codec has gone");
        const auto before = open();
        for (int i = 0; i < 10; ++i) EXPECT_NE(decodeImageMemory(png, kLimits).why, "");
        EXPECT_EQ(open(), before);
    }
    expectWorks(png);
}

// As on a machine of 200 cores, each of which would have a thread with a stack and a heap of its own.
TEST(Codec, ManyCoresTakeNoMoreMemory) {
    ::setenv("OPENIMAGEIO_THREADS", "200", 1);
    if (const pid_t codec = codecProcess()) ::kill(codec, SIGKILL);
    std::this_thread::sleep_for(50ms);
    const test::TemporaryFolder folder;
    Picture picture{600, 800, 3, std::vector<float>(600 * 800 * 3, 0.5f)};
    for (std::size_t i = 0; i < picture.values.size(); ++i) picture.values[i] += 1e-3f * static_cast<float>(i % 977);
    writeExr(folder / "a.exr", picture);
    EXPECT_EQ(readPicture(folder / "a.exr").width, 600);
    ::unsetenv("OPENIMAGEIO_THREADS");
    ::kill(codecProcess(), SIGKILL);  // the next one starts as ever
    std::this_thread::sleep_for(50ms);
}

TEST(Codec, ManyThreadsAtOnce) {
    const std::vector<std::byte> png = smallPng();
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([&] {
            for (int j = 0; j < 8; ++j) expectWorks(png);
        });
    }
}

TEST(Codec, LimitsHoldBeforeAnythingIsDecoded) {
    const std::vector<std::byte> png = smallPng();
    EXPECT_NE(decodeImageMemory(png, {1, 2, 4, 1 << 20}).why, "");
    EXPECT_NE(decodeImageMemory(png, {2, 2, 4, 11}).why, "");
    EXPECT_EQ(decodeImageMemory(png, {2, 2, 4, 16}).why, "");
    EXPECT_NE(encodeImage("no such format", {1, 1, 1}, std::span(png).first(1)).why, "");
    EXPECT_THROW(encodeImage(std::string(100, 'x'), {1, 1, 1}, std::span(png).first(1)), Error);
}

}  // namespace
}  // namespace cutis
