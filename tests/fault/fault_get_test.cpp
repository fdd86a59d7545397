/** tum-get against servers that behave and servers that do not. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>

#include <algorithm>

#include "../support/run_program.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/** tests/support/http_server.py, which ends with this object. */
class HttpServer {
  public:
    explicit HttpServer(const std::string& folder) {
        int ends[2];
        if (pipe(ends) != 0) return;
        pid_ = fork();
        if (pid_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            dup2(ends[1], 1);
            execlp("python3", "python3", RGBD_SOURCE_DIR "/tests/support/http_server.py",
                   folder.c_str(), nullptr);
            _exit(1);
        }
        close(ends[1]);
        std::FILE* out = fdopen(ends[0], "r");
        if (std::fscanf(out, "%d", &port_) != 1) port_ = 0;
        std::fclose(out);
    }
    ~HttpServer() {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    int port() const { return port_; }

  private:
    pid_t pid_ = -1;
    int port_ = 0;
};

class FaultGet : public ::testing::Test {
  protected:
    static constexpr const char* name = "rgbd_dataset_freiburg1_small";

    void SetUp() override {
        small_sequence::make(folder_, name, 8);
        fs::create_directories(folder_ / "www");
        const std::string pack = "tar -czf '" + served() + "' -C '" + folder_ / "" + "' " + name;
        ASSERT_EQ(std::system(pack.c_str()), 0);
        server_ = std::make_unique<HttpServer>(folder_ / "www");
        ASSERT_GT(server_->port(), 0) << "python3 is needed";
    }

    std::string served() const { return folder_ / ("www/" + std::string(name) + ".tgz"); }
    std::string target() const { return folder_ / ("got/" + std::string(name)); }
    std::string part() const { return target() + ".tgz.part"; }
    std::size_t size() const { return fs::file_size(served()); }
    std::string requests() const { return readText(folder_ / "www/requests"); }

    /** \param kind of server, see http_server.py; \param bytes that the table claims */
    ProgramResult get(const std::string& kind, std::size_t bytes = 0, int port = 0,
                      const std::string& more = "") const {
        folder_.write("table.ini", "[fr1/small]\nurl = http://127.0.0.1:" +
                                       std::to_string(port ? port : server_->port()) + "/" + kind +
                                       "/" + name +
                                       ".tgz\nduration_s = 1\nlength_m = 1\ngood_for = testing\n" +
                                       (bytes ? "bytes = " + std::to_string(bytes) + "\n" : ""));
        return runProgram("tum-get", "fr1/small '" + folder_ / "got" + "' --quiet --table '" +
                                         folder_ / "table.ini" + "' " + more);
    }

    void expectWhole() const {
        for (const auto& file : fs::recursive_directory_iterator(folder_ / name)) {
            if (!file.is_regular_file()) continue;
            const auto there = target() / file.path().lexically_relative(folder_ / name);
            EXPECT_EQ(readText(there), readText(file.path())) << there;
        }
        std::size_t entries = 0;
        for (const auto& entry : fs::directory_iterator(folder_ / "got")) {
            EXPECT_EQ(entry.path(), target());
            ++entries;
        }
        EXPECT_EQ(entries, 1u);
    }

    static void expectRefused(const ProgramResult& result, const std::string& reason) {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("tum-get: error: "));
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }

    TestFolder folder_;
    std::unique_ptr<HttpServer> server_;
};

TEST_F(FaultGet, aSequenceArrivesOnce) {
    const auto result = get("range", size());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, target() + "\n");
    EXPECT_EQ(result.err, "");
    expectWhole();
    fs::remove(served());
    EXPECT_EQ(get("range", 1).exit_code, 0) << "it is there already";
}

TEST_F(FaultGet, anInterruptedDownloadGoesOnWhereItStopped) {
    expectRefused(get("cut"), "call again to go on");
    const auto arrived = fs::file_size(part());
    EXPECT_EQ(arrived, size() / 2);
    EXPECT_FALSE(fs::exists(target()));
    EXPECT_EQ(get("range", size()).exit_code, 0);
    EXPECT_THAT(requests(), HasSubstr("/range/" + std::string(name) + ".tgz from " +
                                      std::to_string(arrived) + "\n"));
    expectWhole();
}

TEST_F(FaultGet, aServerWithoutRangesSendsAllAgain) {
    expectRefused(get("cut"), "call again to go on");
    const auto result = get("plain", size());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    expectWhole();
}

TEST_F(FaultGet, aPartThatIsTooLongIsDropped) {
    folder_.write("got/" + std::string(name) + ".tgz.part", std::string(size() + 10, 'x'));
    const auto result = get("range", size());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    expectWhole();
}

TEST_F(FaultGet, aPartThatIsWholeIsNotFetchedAgain) {
    fs::create_directories(folder_ / "got");
    fs::copy_file(served(), part());
    EXPECT_EQ(get("range", size()).exit_code, 0);
    EXPECT_EQ(requests(), "");
    expectWhole();
}

TEST_F(FaultGet, anotherSizeThanExpectedIsRefusedBeforeItIsFetched) {
    expectRefused(get("range", size() + 1), "where " + std::to_string(size() + 1));
    EXPECT_FALSE(fs::exists(part()));
    EXPECT_FALSE(fs::exists(target()));
}

TEST_F(FaultGet, offline) {
    const int closed_port = server_->port();
    server_.reset();
    expectRefused(get("range", size(), closed_port), "check the network and call again");
}

TEST_F(FaultGet, noSuchFile) {
    fs::remove(served());
    expectRefused(get("range"), "the server answers 404");
}

TEST_F(FaultGet, aDamagedArchiveLeavesNoSequence) {
    std::string bytes = readText(served());
    std::fill(bytes.begin() + bytes.size() / 2, bytes.end(), '\0');
    std::ofstream(served(), std::ios::binary) << bytes;
    expectRefused(get("range"), "cannot unpack");
    EXPECT_FALSE(fs::exists(target()));
}

TEST_F(FaultGet, theArchiveIsKeptWhenAskedFor) {
    EXPECT_EQ(get("range", 0, 0, "--keep-archive").exit_code, 0);
    EXPECT_EQ(readText(target() + ".tgz"), readText(served()));
}

TEST_F(FaultGet, unknownSequencesAndTheList) {
    expectRefused(runProgram("tum-get", "fr9/nothing"), "no sequence 'fr9/nothing'");
    expectRefused(runProgram("tum-get", ""), "missing argument SEQ");
    const auto list = runProgram("tum-get", "--list");
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_THAT(
        list.out,
        HasSubstr("fr1/desk                                    23.4 s   9.26 m   344 MB  "));
}

}  // namespace
}  // namespace rgbd_graphslam
