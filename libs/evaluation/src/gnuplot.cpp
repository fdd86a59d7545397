#include "rgbd_graphslam/evaluation/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/printable_text.h"

namespace rgbd_graphslam {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/** Standard input and error of the program are files rather than pipes: neither side can block the
 *  other, and a program that ends early raises no SIGPIPE. */
File scratchFile() {
    File file(std::tmpfile(), std::fclose);
    if (!file) throw Error("cannot make a temporary file", "check free space and $TMPDIR");
    return file;
}

File fileWith(const std::string& text) {
    File file = scratchFile();
    if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0) {
        throw Error("cannot write a temporary file", "check free space");
    }
    std::rewind(file.get());
    return file;
}

/** The lines of a file as one line. */
std::string contentOf(std::FILE* file) {
    std::rewind(file);
    std::string text;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
        const char shown = c == '\n' || c == '\t' ? ' ' : static_cast<char>(c);
        if (shown != ' ' || (!text.empty() && text.back() != ' ')) text += shown;
    }
    return text;
}

pid_t start(const char* program, std::FILE* input, const std::string& output, std::FILE* errors) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(input), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(errors), STDERR_FILENO);
    char* const arguments[] = {const_cast<char*>(program), nullptr};
    pid_t child = 0;
    const int failure = posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure == ENOENT) {
        throw Error("the program gnuplot is not installed", "apt-get install gnuplot-nox");
    }
    if (failure != 0) throw Error(std::string("cannot start gnuplot: ") + std::strerror(failure));
    return child;
}

int exitStatusOf(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw Error(std::string("lost gnuplot: ") + std::strerror(errno));
    }
    return status;
}

/** The picture goes to standard output: a script cannot name every file, as a line end in a literal
 *  begins another command. */
void runGnuplot(const std::string& script, const std::string& picture) {
    const File input = fileWith(script), errors = scratchFile();
    if (exitStatusOf(start("gnuplot", input.get(), picture, errors.get())) != 0) {
        throw Error("gnuplot failed: " + contentOf(errors.get()));
    }
}

std::string terminalFor(const std::string& path, int width, int height) {
    const auto size = [](int w, int h) {
        return " size " + std::to_string(w) + "," + std::to_string(h);
    };
    const std::string extension = std::filesystem::path(path).extension();
    if (extension == ".png") {
        return "pngcairo noenhanced" + size(2 * width, 2 * height) +
               " fontscale 2 linewidth 2 pointscale 2 font 'Sans,11'";
    }
    if (extension == ".svg") {
        return "svg noenhanced" + size(width, height) +
               " dynamic background '#ffffff' font 'Helvetica,Arial,sans-serif,14'";
    }
    throw Error("'" + path + "' is no picture gnuplot is asked for here",
                "name a file ending in .png or .svg");
}

}  // namespace

Gnuplot::Gnuplot(std::string path, int width, int height)
    : path_(std::move(path)), terminal_(terminalFor(path_, width, height)) {}

void Gnuplot::command(const std::string& line) {
    commands_ += line + "\n";
}

std::string Gnuplot::data(const Rows& rows) {
    std::string name = "$block" + std::to_string(block_count_++);
    blocks_ += name + " << END_OF_BLOCK\n";
    for (const auto& row : rows) {
        for (const double value : row) {
            char text[32];
            std::snprintf(text, sizeof(text), "%.9g ", value);
            blocks_ += text;
        }
        blocks_ += "\n";
    }
    blocks_ += "END_OF_BLOCK\n";
    return name;
}

void Gnuplot::draw() const {
    writeAtomically(path_, [&](const std::string& temporary) {
        if (!std::ofstream(temporary)) return false;
        runGnuplot("set terminal " + terminal_ + "\n" + blocks_ + commands_ + "unset output\n",
                   temporary);
        return std::filesystem::file_size(temporary) > 0;
    });
}

std::string Gnuplot::quoted(const std::string& text) {
    std::string literal = "'";
    for (const char c : printableLine(text)) literal += c == '\'' ? "''" : std::string(1, c);
    return literal + "'";
}

}  // namespace rgbd_graphslam
