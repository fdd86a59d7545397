#include "live_sensors.h"

#include <dlfcn.h>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/installed_files.h"

namespace rgbd_graphslam {

std::shared_ptr<void> startLiveSensors(const std::string& ini,
                                       const std::shared_ptr<LiveSource>& source) {
    using Start =
        void(const std::string&, const std::shared_ptr<LiveSource>&, std::shared_ptr<void>&);
    const std::string module = siblingProgram("../lib/rgbd_graphslam/rgbd_live_sensors.so");
    void* const loaded = dlopen(module.c_str(), RTLD_NOW);  // for good: threads run in it
    void* const start = loaded ? dlsym(loaded, "rgbdStartLiveSensors") : nullptr;
    if (!start) {
        const char* const reason = dlerror();
        throw Error("sensors cannot be read: " + std::string(reason ? reason : module),
                    "install the programs again");
    }
    std::shared_ptr<void> sensors;
    reinterpret_cast<Start*>(start)(ini, source, sensors);
    return sensors;
}

}  // namespace rgbd_graphslam
