/** One picture drawn by gnuplot. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Collects a gnuplot script and its data; the program runs when the picture is drawn. */
class Gnuplot {
  public:
    /** A row of numbers; an empty row interrupts a line. */
    using Rows = std::vector<std::vector<double>>;

    /** \param path ends in .png or .svg, which chooses the format
     *  \param width, height in points of a page; a PNG has twice as many pixels
     *  \throws Error for another ending */
    Gnuplot(std::string path, int width, int height);

    /** Adds one line of the script. */
    void command(const std::string& line);

    /** Makes numbers known to the script. \return the name to plot them by */
    std::string data(const Rows& rows);

    /** Writes the picture, whole or not at all.
     *  \throws Error when gnuplot is missing, refuses the script or the file cannot be written */
    void draw() const;

    /** A text as a literal of the script, where it is one line of letters: see printableLine(). */
    static std::string quoted(const std::string& text);

  private:
    std::string path_;
    std::string terminal_;
    std::string blocks_, commands_;
    int block_count_ = 0;
};

}  // namespace rgbd_graphslam
