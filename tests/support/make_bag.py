#!/usr/bin/python3
"""Writes a ROS 1 bag with Debian's python3-rosbag: make_bag.py OUT.bag COMPRESSION < lines, which are

image TOPIC FRAME STAMP ENCODING WIDTH HEIGHT FILE   pixels as they are in FILE
compressed TOPIC FRAME STAMP FORMAT FILE             FORMAT with ~ for blanks
camera_info TOPIC FRAME STAMP WIDTH HEIGHT fx fy cx cy D...
imu TOPIC STAMP ax ay az                             the gyroscope's covariance says there is none
imu6 TOPIC FRAME STAMP ax ay az wx wy wz
tf TOPIC STAMP PARENT CHILD x y z qx qy qz qw
odometry TOPIC FRAME STAMP CHILD x y yaw
scan TOPIC FRAME STAMP angle_min angle_increment range_min range_max ranges...
fix TOPIC FRAME STAMP status latitude longitude altitude
extrinsics TOPIC STAMP x y z                         realsense2_camera/Extrinsics, not turned
transform TOPIC STAMP x y z qx qy qz qw              geometry_msgs/Transform
number TOPIC STAMP value                             std_msgs/Float32
string TOPIC STAMP text

ros2/make_bag.mjs writes ROS 2 bags of the same lines.
"""
import math
import sys

import genpy
import genpy.dynamic
import geometry_msgs.msg
import nav_msgs.msg
import rosbag
import sensor_msgs.msg
import std_msgs.msg
import tf2_msgs.msg

EXTRINSICS = genpy.dynamic.generate_dynamic("realsense2_camera/Extrinsics", """Header header
float64[9] rotation
float64[3] translation
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
""")["realsense2_camera/Extrinsics"]


def time(stamp):
    seconds, microseconds = stamp.split(".")
    return genpy.Time(int(seconds), int(microseconds.ljust(6, "0")) * 1000)


def stamped(message, frame, stamp):
    message.header.frame_id, message.header.stamp = frame, time(stamp)
    return message, message.header.stamp


def bytes_of(file):
    with open(file, "rb") as opened:
        return opened.read()


def image(frame, stamp, encoding, width, height, file):
    message = sensor_msgs.msg.Image(height=int(height), width=int(width), encoding=encoding)
    message.data = bytes_of(file)
    message.step = len(message.data) // message.height
    return stamped(message, frame, stamp)


def compressed(frame, stamp, form, file):
    message = sensor_msgs.msg.CompressedImage(format=form.replace("~", " "), data=bytes_of(file))
    return stamped(message, frame, stamp)


def camera_info(frame, stamp, width, height, fx, fy, cx, cy, *coefficients):
    message = sensor_msgs.msg.CameraInfo(height=int(height), width=int(width))
    message.distortion_model = "plumb_bob" if len(coefficients) <= 5 else "rational_polynomial"
    message.D = [float(d) for d in coefficients]
    message.K = [float(fx), 0, float(cx), 0, float(fy), float(cy), 0, 0, 1]
    message.P = [float(fx), 0, float(cx), 0, 0, float(fy), float(cy), 0, 0, 0, 1, 0]
    return stamped(message, frame, stamp)


def vector(values):
    return geometry_msgs.msg.Vector3(*map(float, values))


def imu(stamp, *acceleration):
    message = sensor_msgs.msg.Imu(linear_acceleration=vector(acceleration))
    message.angular_velocity_covariance[0] = -1
    return stamped(message, "", stamp)


def imu6(frame, stamp, *values):
    message = sensor_msgs.msg.Imu(linear_acceleration=vector(values[:3]),
                                  angular_velocity=vector(values[3:]))
    return stamped(message, frame, stamp)


def rigid_motion(values):
    return geometry_msgs.msg.Transform(
        vector(values[:3]), geometry_msgs.msg.Quaternion(*map(float, values[3:])))


def tf(stamp, parent, child, *values):
    transform = geometry_msgs.msg.TransformStamped(child_frame_id=child,
                                                   transform=rigid_motion(values))
    stamped(transform, parent, stamp)
    return tf2_msgs.msg.TFMessage([transform]), transform.header.stamp


def odometry(frame, stamp, child, x, y, yaw):
    message = nav_msgs.msg.Odometry(child_frame_id=child)
    message.pose.pose.position = geometry_msgs.msg.Point(float(x), float(y), 0)
    message.pose.pose.orientation = geometry_msgs.msg.Quaternion(
        0, 0, math.sin(float(yaw) / 2), math.cos(float(yaw) / 2))
    return stamped(message, frame, stamp)


def scan(frame, stamp, angle_min, increment, range_min, range_max, *ranges):
    message = sensor_msgs.msg.LaserScan(angle_min=float(angle_min), angle_increment=float(increment),
                                        range_min=float(range_min), range_max=float(range_max))
    message.angle_max = message.angle_min + message.angle_increment * (len(ranges) - 1)
    message.ranges = [float(value) for value in ranges]
    return stamped(message, frame, stamp)


def fix(frame, stamp, status, latitude, longitude, altitude):
    message = sensor_msgs.msg.NavSatFix(latitude=float(latitude), longitude=float(longitude),
                                        altitude=float(altitude))
    message.status.status = int(status)
    return stamped(message, frame, stamp)


def extrinsics(stamp, *translation):
    message = EXTRINSICS(rotation=[1, 0, 0, 0, 1, 0, 0, 0, 1])
    message.translation = [float(value) for value in translation]
    return stamped(message, "depth_to_color", stamp)


def transform(stamp, *values):
    return rigid_motion(values), time(stamp)


def number(stamp, value):
    return std_msgs.msg.Float32(float(value)), time(stamp)


def string(stamp, text):
    return std_msgs.msg.String(text), time(stamp)


with rosbag.Bag(sys.argv[1], "w", compression=sys.argv[2]) as bag:
    for line in sys.stdin:
        kind, topic, *words = line.split()
        message, stamp = globals()[kind](*words)
        bag.write(topic, message, stamp)
