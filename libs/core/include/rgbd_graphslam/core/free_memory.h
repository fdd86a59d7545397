/** Giving memory back. */
#pragma once

namespace rgbd_graphslam {

/** Empties a container. Assigning {} to a vector keeps what it had reserved. */
template <class Container>
void freeMemory(Container& container) {
    Container().swap(container);
}

}  // namespace rgbd_graphslam
