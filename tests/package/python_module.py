"""Usage: python_module.py MODULE_FOLDER SEQUENCE: tracks and maps the PNG images of a TUM sequence
in Python, and shows that arrays of other shapes are refused."""
import pathlib
import sys

import numpy as np
from PIL import Image

sys.path.insert(0, sys.argv[1])
import rgbd_graphslam as rg  # noqa: E402

SEQUENCE = pathlib.Path(sys.argv[2])
FRAMES = 40


def listed(name):
    lines = (SEQUENCE / name).read_text(encoding="utf-8").splitlines()
    return [line.split() for line in lines if line and line[0] != "#"]


def images():
    for (stamp, color), (_, depth) in list(zip(listed("rgb.txt"), listed("depth.txt")))[:FRAMES]:
        rgb = np.asarray(Image.open(SEQUENCE / color))
        bgr = np.ascontiguousarray(rgb[:, :, ::-1])
        yield float(stamp), bgr, np.asarray(Image.open(SEQUENCE / depth)).astype(np.uint16)


def expect_refused(call, text):
    try:
        call()
    except (ValueError, RuntimeError) as refusal:
        assert text in str(refusal), refusal
    else:
        raise AssertionError(f"taken: {text}")


def true_motion():
    """From the first frame to the last, m."""
    truth = np.array(listed("groundtruth.txt"), dtype=float)
    at = [np.argmin(abs(truth[:, 0] - float(listed("rgb.txt")[i][0]))) for i in (0, FRAMES - 1)]
    return np.linalg.norm(truth[at[1], 1:4] - truth[at[0], 1:4])


def check_slam(camera):
    slam = rg.Slam(camera, depth_units=5000)
    expect_refused(slam.points, "no map yet")
    for stamp, color, depth in images():
        frame = slam.track(stamp, color, depth)
        assert frame.state == "tracked", (stamp, frame.state)
        assert frame.pose.shape == (4, 4) and frame.covariance.shape == (6, 6)
    slam.finish()
    expect_refused(lambda: slam.track(0, color, depth), "not later")
    expect_refused(lambda: slam.track(1e9, color[::2].copy(), depth), "image is")
    expect_refused(lambda: slam.track(1e9, color[:, ::2], depth), "color is")
    expect_refused(lambda: slam.track(1e9, color, depth.astype(np.int32)), "int32")
    return slam


def check_maps(slam):
    stamps, poses = slam.trajectory()
    assert stamps.shape == (FRAMES,) and poses.shape == (FRAMES, 4, 4)
    moved = np.linalg.norm(poses[-1, :3, 3] - poses[0, :3, 3])
    assert abs(moved - true_motion()) < 0.01, (moved, true_motion())
    xyz, rgb = slam.points(voxel=0.02)
    assert len(xyz) == len(rgb) > 10000 and rgb.dtype == np.uint8
    up = slam.T_up_world()[:3, :3] @ slam.landmarks().T
    assert slam.landmarks().shape[1] == 3 and np.isfinite(up).all()
    occupied, origin, resolution = slam.grid(resolution=0.05)
    assert occupied.ndim == 2 and len(origin) == 2 and abs(resolution - 0.05) < 1e-6
    assert (occupied > 0.6).sum() > 10 and (occupied < 0.4).sum() > 10


def check_depth_in_meters(camera):
    poses = []
    for as_meters in (False, True):
        slam = rg.Slam(camera, depth_units=5000)
        for stamp, color, depth in list(images())[:5]:
            meters = np.where(depth > 0, depth / 5000, np.nan).astype(np.float32)
            poses.append(slam.track(stamp, color, meters if as_meters else depth).pose)
    assert np.allclose(poses[:5], poses[5:], atol=1e-3)


if __name__ == "__main__":
    ini = (SEQUENCE / "camera.ini").read_text(encoding="utf-8")
    values = {k.strip(): v.split("//")[0].strip() for k, v in
              (line.split("=", 1) for line in ini.splitlines() if "=" in line)}
    width, height = (int(x) for x in values["resolution"].strip("[]").split())
    office = rg.Camera(width, height, *(float(values[k]) for k in ("fx", "fy", "cx", "cy")))
    check_maps(check_slam(office))
    check_depth_in_meters(office)
