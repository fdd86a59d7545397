#!/usr/bin/python3
"""Writes a bag with Debian's python3-rosbag: make_bag.py OUT.bag COMPRESSION < lines, which are

image TOPIC FRAME STAMP ENCODING WIDTH HEIGHT FILE   pixels as they are in FILE
camera_info TOPIC FRAME STAMP WIDTH HEIGHT fx fy cx cy D...
imu TOPIC STAMP ax ay az
tf TOPIC STAMP PARENT CHILD x y z qx qy qz qw
"""
import sys

import genpy
import geometry_msgs.msg
import rosbag
import sensor_msgs.msg
import tf2_msgs.msg


def time(stamp):
    seconds, microseconds = stamp.split(".")
    return genpy.Time(int(seconds), int(microseconds) * 1000)


def image(frame, stamp, encoding, width, height, file):
    message = sensor_msgs.msg.Image(height=int(height), width=int(width), encoding=encoding)
    message.header.frame_id, message.header.stamp = frame, time(stamp)
    with open(file, "rb") as pixels:
        message.data = pixels.read()
    message.step = len(message.data) // message.height
    return message, message.header.stamp


def camera_info(frame, stamp, width, height, fx, fy, cx, cy, *coefficients):
    message = sensor_msgs.msg.CameraInfo(height=int(height), width=int(width),
                                         distortion_model="plumb_bob")
    message.header.frame_id, message.header.stamp = frame, time(stamp)
    message.D = [float(d) for d in coefficients]
    message.K = [float(fx), 0, float(cx), 0, float(fy), float(cy), 0, 0, 1]
    return message, message.header.stamp


def imu(stamp, *acceleration):
    message = sensor_msgs.msg.Imu()
    message.header.stamp = time(stamp)
    message.linear_acceleration = geometry_msgs.msg.Vector3(*map(float, acceleration))
    message.angular_velocity_covariance[0] = -1
    return message, message.header.stamp


def tf(stamp, parent, child, *values):
    numbers = [float(value) for value in values]
    transform = geometry_msgs.msg.TransformStamped(child_frame_id=child)
    transform.header.frame_id, transform.header.stamp = parent, time(stamp)
    transform.transform.translation = geometry_msgs.msg.Vector3(*numbers[:3])
    transform.transform.rotation = geometry_msgs.msg.Quaternion(*numbers[3:])
    return tf2_msgs.msg.TFMessage([transform]), transform.header.stamp


MAKERS = {"image": image, "camera_info": camera_info, "imu": imu, "tf": tf}

with rosbag.Bag(sys.argv[1], "w", compression=sys.argv[2]) as bag:
    for line in sys.stdin:
        kind, topic, *words = line.split()
        message, stamp = MAKERS[kind](*words)
        bag.write(topic, message, stamp)
