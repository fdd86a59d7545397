/** Scenarios in which something deceives the camera or the wheels, each in a file of its own. */
#pragma once
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {

Scenario crowd();
Scenario followMe();
Scenario door();
Scenario chairMoved();
Scenario pushedCart();
Scenario startsInCrowd();
Scenario lift();
Scenario underDesk();
Scenario ceilingLamp();
Scenario armInView();
Scenario dirtyLens();
Scenario blackout();
Scenario blackoutRobot();
Scenario wheelSlip();
Scenario glassCorridor();

}  // namespace rgbd_graphslam::synth
