/** Images and poses whose names are all that tells when they were taken. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Files of a folder by the numbers in their names. */
struct NumberedFiles {
    struct File {
        double number;
        /** Relative to the sequence's folder. */
        std::string name;
    };
    /** In ascending order. */
    std::vector<File> files;
    /** Some names are numbers with decimals; some have leading zeros. */
    bool with_decimals = false, padded = false;
};

/** The files of `folder`/`subfolder` whose names end as one of `endings`, in any case. The number
 * is the name's last one. \throws Error for a name without a number */
NumberedFiles filesByNumber(const std::string& folder, const std::string& subfolder,
                            const std::vector<std::string>& endings);

/** What numbers in names count. */
struct NumberMeaning {
    double seconds = 1;
    /** A line for the user. */
    std::string said;
};

/** Frame numbers at a rate, or stamps in s, ms, us or ns. */
NumberMeaning meaningOf(const NumberedFiles& files, double rate_hz);

std::vector<ListedImage> stamped(const NumberedFiles& files, const NumberMeaning& meaning);

/** filesByNumber, all of them frame numbers taken at number / rate_hz. */
std::vector<ListedImage> numberedFiles(const std::string& folder, const std::string& subfolder,
                                       const std::vector<std::string>& endings, double rate_hz);

/** Poses in files of 4x4 matrices, row by row, camera to world. Matrices with infinite numbers, as
 *  recorders write for frames they could not place, are left out.
 *  \throws Error naming the file for anything else */
Trajectory readPoseFiles(const std::string& folder, const std::vector<ListedImage>& files);

}  // namespace rgbd_graphslam
