#include "checkpoint.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "sealed_file.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

const FileKind checkpoint_file{"RGBDCKP\n",
                               Checkpoint::format,
                               "checkpoint",
                               "there is nothing to go on from, run it from the start",
                               "run it from the start",
                               "run it from the start"};

constexpr std::uint64_t marked_bytes = 1 << 20;  // at each of three places

std::string encoded(const Checkpoint& checkpoint) {
    ByteWriter out;
    out.putText(RGBD_VERSION);
    out.putText(checkpoint.job.rawlog);
    out.put(checkpoint.rawlog.bytes);
    out.put(checkpoint.rawlog.checksum);
    out.putText(configText(checkpoint.job.options));
    out.putText(checkpoint.job.map_folder);
    out.put<std::uint8_t>(checkpoint.job.map_use == MapUse::Extend);
    out.putText(checkpoint.state);
    if (!checkpoint.job.sensor_label.empty()) out.putText(checkpoint.job.sensor_label);
    return out.bytes();
}

JobOptions optionsFrom(const std::string& ini_text) {
    JobOptions options;
    IniFile::fromText(ini_text, "the settings in the checkpoint").load(options.all());
    return options;
}

Checkpoint decoded(ByteReader& in, const std::string& path) {
    const std::string version = in.getText();
    if (version != RGBD_VERSION) {
        throw Error("the checkpoint '" + path + "' is of version " + version +
                        " of the program, this is " + RGBD_VERSION,
                    "go on with that version, or run it from the start");
    }
    Checkpoint checkpoint;
    checkpoint.job.rawlog = in.getText();
    checkpoint.rawlog.bytes = in.get<std::uint64_t>();
    checkpoint.rawlog.checksum = in.get<std::uint32_t>();
    checkpoint.job.options = optionsFrom(in.getText());
    checkpoint.job.map_folder = in.getText();
    checkpoint.job.map_use = in.get<std::uint8_t>() ? MapUse::Extend : MapUse::Localize;
    checkpoint.state = in.getText();
    if (in.left() > 0) checkpoint.job.sensor_label = in.getText();
    return checkpoint;
}

void checkSame(const RawlogMark& then, const std::string& rawlog) {
    const RawlogMark now = markOf(rawlog);
    if (now.bytes == then.bytes && now.checksum == then.checksum) return;
    throw Error("the rawlog '" + rawlog + "' is not the one that the checkpoint was written for",
                "put that back in its place, or run this one from the start");
}

}  // namespace

RawlogMark markOf(const std::string& rawlog) {
    std::ifstream in(rawlog, std::ios::binary | std::ios::ate);
    if (!in || !fs::is_regular_file(rawlog)) {
        throw Error("cannot read the rawlog '" + rawlog + "'", "check its name");
    }
    RawlogMark mark;
    mark.bytes = static_cast<std::uint64_t>(in.tellg());
    const std::uint64_t length = std::min(mark.bytes, marked_bytes);
    std::string pieces;
    for (const std::uint64_t begin :
         {std::uint64_t{0}, (mark.bytes - length) / 2, mark.bytes - length}) {
        std::string piece(length, '\0');
        in.seekg(static_cast<std::streamoff>(begin));
        in.read(piece.data(), static_cast<std::streamsize>(length));
        pieces += piece;
    }
    mark.checksum = checksumOf(pieces);
    return mark;
}

std::string checkpointPath(const std::string& out_folder) {
    return out_folder + "/checkpoint";
}

Checkpoint readCheckpoint(const std::string& out_folder) {
    const std::string path = checkpointPath(out_folder);
    const std::string payload = readSealed(path, checkpoint_file).bytes;
    try {
        ByteReader in(payload);
        Checkpoint checkpoint = decoded(in, path);
        checkpoint.job.out_folder = out_folder;
        checkSame(checkpoint.rawlog, checkpoint.job.rawlog);
        return checkpoint;
    } catch (const DamagedBytes& e) {
        throw damaged(path, checkpoint_file, e);
    }
}

CheckpointWriter::CheckpointWriter(const SlamJob& job, std::size_t progress)
    : job_(job),
      interval_(job.localizes() || job.live ? 0 : job.options.run.checkpoint_keyframes),
      last_(progress) {
    job_.rawlog = fs::absolute(job.rawlog).lexically_normal().string();
    if (!job.map_folder.empty()) {
        job_.map_folder = fs::absolute(job.map_folder).lexically_normal().string();
    }
    if (enabled()) rawlog_ = markOf(job.rawlog);
}

CheckpointWriter::~CheckpointWriter() {
    wait();
}

bool CheckpointWriter::due(std::size_t progress) const {
    // A map's bytes grow with it: a tenth more keeps the cost of all checkpoints in proportion.
    return enabled() && progress >= last_ + std::max(interval_, last_ / 10);
}

void CheckpointWriter::write(std::size_t progress, std::string state) {
    wait();
    last_ = progress;
    writing_ = std::async(std::launch::async, [this, state = std::move(state)]() mutable {
        writeSealed(checkpointPath(job_.out_folder), checkpoint_file,
                    encoded({job_, rawlog_, std::move(state)}));
    });
}

void CheckpointWriter::wait() {
    if (!writing_.valid()) return;
    try {
        writing_.get();
    } catch (const Error& e) {
        if (!warned_) sayWarning(std::string("no checkpoint: ") + e.what());
        warned_ = true;
    }
}

void CheckpointWriter::remove() {
    wait();
    std::error_code ignored;
    fs::remove(checkpointPath(job_.out_folder), ignored);
}

}  // namespace rgbd_graphslam
