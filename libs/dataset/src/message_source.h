/** Recorded messages, whatever kind of file they are in. */
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "wire_reader.h"

namespace rgbd_graphslam {

/** One recorded message, still as ROS serialized it; all of it belongs to the source. */
struct RecordedMessage {
    const std::string& topic;
    /** As ROS 1 writes it, e.g. "sensor_msgs/Image". */
    const std::string& type;
    WireFormat format;
    std::string_view bytes;
    /** When it was recorded, which is later than its stamp. */
    double recorded_s = 0;

    WireReader reader() const { return WireReader(bytes, format); }
};

/** \param share of the recording that is read */
using UseMessage = std::function<void(const RecordedMessage&, double share)>;

/** A file of messages. */
class MessageSource {
  public:
    virtual ~MessageSource() = default;

    /** Calls `use` with each message in the order of recording; can be called again.
     *  \return what is missing where the recorder was killed before it closed the file, or empty
     *  \throws Error where the file is damaged */
    virtual std::string forEachMessage(const UseMessage& use) = 0;
};

/** ROS 2 puts "/msg/" in the middle of a type. */
std::string withoutMsg(std::string type);

}  // namespace rgbd_graphslam
