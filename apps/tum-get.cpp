/** tum-get: fetches sequences of the TUM RGB-D benchmark. */
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/benchmark/fetch_sequence.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/installed_files.h"

namespace rgbd_graphslam {
namespace {

struct Arguments {
    std::string sequence, folder = ".", table;
    bool list = false, keep_archive = false;
};

void declare(CLI::App& app, Arguments& args) {
    app.add_option("SEQ", args.sequence, "Sequence, e.g. fr1/desk; see --list");
    app.add_option("DIR", args.folder, "Folder to put it in")->capture_default_str();
    app.add_flag("--list", args.list, "Print the sequences with duration, path length and size");
    app.add_flag("--keep-archive", args.keep_archive, "Keep the .tgz beside the unpacked folder");
    app.add_option("--table", args.table, "Ini file of the sequences; default: the shipped one");
    declareExamples(app, {"tum-get --list", "tum-get fr1/desk ~/tum"});
    declareCommonOptions(app);
}

int run(const Arguments& args) {
    const auto table =
        readSequenceTable(args.table.empty() ? shippedIni("tum-sequences.ini") : args.table);
    if (args.list) {
        std::fputs(toText(table).c_str(), stdout);
        return 0;
    }
    if (args.sequence.empty()) throw Error("missing argument SEQ", "see tum-get --list");
    const KnownSequence* sequence = findSequence(table, args.sequence);
    if (!sequence) {
        throw Error("there is no sequence '" + args.sequence + "'", "see tum-get --list");
    }
    std::printf("%s\n", fetchSequence(*sequence, args.folder, args.keep_archive).c_str());
    return 0;
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    using namespace rgbd_graphslam;
    CLI::App app("Downloads and unpacks sequences of the TUM RGB-D benchmark", "tum-get");
    Arguments args;
    declare(app, args);
    return runProgram(app, argc, argv, [&] { return run(args); });
}
