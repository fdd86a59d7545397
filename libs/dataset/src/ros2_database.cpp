#include "ros2_database.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"
#include "unpacked_bytes.h"

namespace rgbd_graphslam {
namespace {

std::string textOf(sqlite3_stmt* row, int column) {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
    return text ? text : "";
}

std::string_view blobOf(sqlite3_stmt* row, int column) {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row, column));
    return {bytes, bytes ? static_cast<std::size_t>(sqlite3_column_bytes(row, column)) : 0};
}

/** A file from elsewhere shall not run code of its own, nor claim what it does not hold. */
void distrust(sqlite3* database, std::uintmax_t file_bytes) {
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    const auto most = std::min<std::uintmax_t>(file_bytes, largest_unpacked);
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(most));
    sqlite3_exec(database, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
}

}  // namespace

Ros2Database::Ros2Database(const std::string& path)
    : path_(path), database_(nullptr, sqlite3_close) {
    sqlite3* database = nullptr;
    const int status = sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(database);
    if (status != SQLITE_OK) refuse();
    distrust(database, std::filesystem::file_size(path));
    readTopics();
}

void Ros2Database::refuse() const {
    const int status = sqlite3_errcode(database_.get());
    const bool failed = status != SQLITE_OK && status != SQLITE_ROW && status != SQLITE_DONE;
    const std::string why = failed ? sqlite3_errmsg(database_.get()) : "it lacks a table";
    throw Error("'" + path_ + "' is damaged or no ROS 2 bag (" + why + ")", "copy it again");
}

Ros2Database::Statement Ros2Database::prepare(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    const int status = sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
    Statement result(statement, sqlite3_finalize);
    if (status != SQLITE_OK) refuse();
    return result;
}

/** \return whether there is a row */
bool Ros2Database::step(const Statement& statement) const {
    const int status = sqlite3_step(statement.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) refuse();
    return status == SQLITE_ROW;
}

void Ros2Database::readTopics() {
    // A view could be of any length, whatever the file's.
    const auto tables = prepare(
        "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('topics', "
        "'messages')");
    constexpr int expected = 2;
    if (!step(tables) || sqlite3_column_int(tables.get(), 0) != expected) refuse();
    const auto topics = prepare("SELECT id, name, type, serialization_format FROM topics");
    while (step(topics)) {
        topics_[sqlite3_column_int64(topics.get(), 0)] = {textOf(topics.get(), 1),
                                                          withoutMsg(textOf(topics.get(), 2)),
                                                          textOf(topics.get(), 3) == "cdr"};
    }
    const auto last = prepare("SELECT max(id) FROM messages");
    if (step(last)) last_id_ = sqlite3_column_int64(last.get(), 0);
}

std::string Ros2Database::forEachMessage(const UseMessage& use) {
    const auto rows = prepare("SELECT id, topic_id, timestamp, data FROM messages ORDER BY id");
    while (step(rows)) {
        const auto topic = topics_.find(sqlite3_column_int64(rows.get(), 1));
        if (topic == topics_.end() || !topic->second.is_cdr) continue;
        const double share = static_cast<double>(sqlite3_column_int64(rows.get(), 0)) /
                             static_cast<double>(std::max<std::int64_t>(1, last_id_));
        const double recorded_s = 1e-9 * static_cast<double>(sqlite3_column_int64(rows.get(), 2));
        use({topic->second.name, topic->second.type, WireFormat::Cdr, blobOf(rows.get(), 3),
             recorded_s},
            share);
    }
    return "";
}

}  // namespace rgbd_graphslam
