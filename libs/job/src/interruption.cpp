#include "interruption.h"

namespace rgbd_graphslam {
namespace {

volatile std::sig_atomic_t signalled = 0;

void note(int) {
    signalled = 1;
}

}  // namespace

Interruption::Interruption() {
    signalled = 0;
    struct sigaction action = {};
    action.sa_handler = note;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &action, &old_int_);
    sigaction(SIGTERM, &action, &old_term_);
}

Interruption::~Interruption() {
    sigaction(SIGINT, &old_int_, nullptr);
    sigaction(SIGTERM, &old_term_, nullptr);
}

bool Interruption::requested() const {
    return signalled != 0;
}

}  // namespace rgbd_graphslam
