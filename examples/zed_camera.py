#!/usr/bin/env python3
"""A ZED stereo camera through shared memory: HD1080 at 30 frames/s, a point cloud of 480 × 480.

    python3 examples/zed_camera.py [--layout farpoint|reference] [--fps 30] [--size 480] [--track] [--flip] [--folder /dev/shm]

The ZED SDK (https://www.stereolabs.com/developers), version 5, contains the module pyzed. --fps sets the number of clouds per
second, up to the camera's 30. --track adds the camera's pose to each cloud, from the SDK's positional tracking. The program
ends when the camera fails or disappears: let a supervisor restart it.
"""
import argparse
import os
import sys
import time

try:
    import numpy as np
except ImportError:
    sys.exit("numpy is missing: install it with `pip install numpy` (Debian: `apt-get install python3-numpy`)")

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "packages", "shared-memory", "python"))
from farpoint_shm import CloudProducer, ReferenceProducer, pack_points, sample_points  # noqa: E402

# Rotation from optical axes (z forward, x right, y down) to the world's (x forward, y left, z up), as x, y, z, w.
OPTICAL_IN_WORLD = (-0.5, 0.5, -0.5, 0.5)
CAMERA_FPS = 30
# Warnings after which a grab has no picture, by name, because not every SDK has them. After other warnings it has
# one.
NO_PICTURE = ("CAMERA_REBOOTING", "CORRUPTED_FRAME")


def load_sdk():
    try:
        import pyzed.sl as sl
    except ImportError:
        sys.exit("pyzed is missing: install the ZED SDK with its Python API (https://www.stereolabs.com/developers)")
    return sl


def multiply(a, b):
    """Hamilton product of two quaternions x, y, z, w."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def demand(sl, status, what):
    """Exits if a call failed. Codes below SUCCESS are warnings: the call was carried out, though not exactly as requested."""
    if status.value > sl.ERROR_CODE.SUCCESS.value:
        sys.exit(f"{what}: {status!r}")
    if status != sl.ERROR_CODE.SUCCESS:
        print(f"{what}: {status!r}", file=sys.stderr)


class Zed:
    """Clouds in metres in the optical frame, which is the SDK's IMAGE coordinate system."""

    def __init__(self, options):
        self.sl = sl = load_sdk()
        parameters = sl.InitParameters()
        parameters.camera_resolution = sl.RESOLUTION.HD1080
        parameters.camera_fps = CAMERA_FPS
        parameters.depth_mode = sl.DEPTH_MODE.NEURAL
        parameters.coordinate_units = sl.UNIT.METER
        parameters.coordinate_system = sl.COORDINATE_SYSTEM.IMAGE
        parameters.camera_image_flip = sl.FLIP_MODE.ON if options.flip else sl.FLIP_MODE.OFF
        self.camera = sl.Camera()
        demand(sl, self.camera.open(parameters), "opening the camera")
        self.tracking = options.track
        if self.tracking:
            demand(sl, self.camera.enable_positional_tracking(sl.PositionalTrackingParameters()), "tracking its position")
        self.resolution = sl.Resolution(options.size, options.size)
        left = self.camera.get_camera_information(self.resolution).camera_configuration.calibration_parameters.left_cam
        self.lens = (left.fx, left.fy, left.cx, left.cy)
        self.runtime = sl.RuntimeParameters(confidence_threshold=100)
        self.cloud, self.pose = sl.Mat(), sl.Pose()

    def grab(self):
        """The next cloud, float32 of shape (size, size, 4) with the colour's bytes in the fourth element, and its capture time."""
        sl = self.sl
        status = self.camera.grab(self.runtime)
        if status.name in NO_PICTURE:
            # While the camera boots, grabs return immediately.
            time.sleep(0.01)
            return None
        if status.value > sl.ERROR_CODE.SUCCESS.value:
            sys.exit(f"the camera gives no more pictures: {status!r}")
        # The SDK uses the system clock: subtract the image's age from the monotonic time.
        now = self.camera.get_timestamp(sl.TIME_REFERENCE.CURRENT).get_nanoseconds()
        age_ns = now - self.camera.get_timestamp(sl.TIME_REFERENCE.IMAGE).get_nanoseconds()
        capture_ns = time.monotonic_ns() - max(0, age_ns)
        # Passed by position, because the third argument has had two names.
        status = self.camera.retrieve_measure(self.cloud, sl.MEASURE.XYZRGBA, sl.MEM.CPU, self.resolution)
        if status.value > sl.ERROR_CODE.SUCCESS.value:
            sys.exit(f"no cloud of {self.resolution.width} × {self.resolution.height} to be had: {status!r}")
        return self.cloud.get_data(), capture_ns

    def world_pose(self):
        """Position and orientation of the camera in the world, or (None, None)."""
        sl = self.sl
        if not self.tracking:
            return None, None
        if self.camera.get_position(self.pose, sl.REFERENCE_FRAME.WORLD) != sl.POSITIONAL_TRACKING_STATE.OK:
            return None, None
        x, y, z = self.pose.get_translation().get()
        orientation = multiply(OPTICAL_IN_WORLD, tuple(self.pose.get_orientation().get()))
        return (z, -x, -y), orientation


def main():
    parser = argparse.ArgumentParser(description="A ZED camera's clouds through shared memory.")
    parser.add_argument("--layout", choices=["farpoint", "reference"], default="farpoint")
    parser.add_argument("--fps", type=float, default=30.0)
    parser.add_argument("--size", type=int, default=480, help="width and height of the cloud")
    parser.add_argument("--track", action="store_true", help="also write the camera's pose")
    parser.add_argument("--flip", action="store_true", help="the camera hangs upside down")
    parser.add_argument("--folder", default="/dev/shm")
    options = parser.parse_args()
    zed = Zed(options)
    show = reference_output(options) if options.layout == "reference" else farpoint_output(zed, options)
    due = time.monotonic()
    while True:
        grabbed = zed.grab()
        # The camera has its own rate. Skip a frame for which no cloud is due.
        if grabbed is None or time.monotonic() < due - 0.5 / CAMERA_FPS:
            continue
        show(*grabbed)
        due = max(due + 1 / options.fps, time.monotonic())


def farpoint_output(zed, options):
    producer = CloudProducer(options.size, options.size, "points", min(options.fps, CAMERA_FPS), options.folder)

    def show(cloud, capture_ns):
        # Copied as words: a colour's bits may be those of a NaN.
        producer.begin().view(np.uint32)[...] = cloud.view(np.uint32)
        position, orientation = zed.world_pose()
        producer.publish(capture_ns, position, orientation, zed.lens)

    return show


def reference_output(options):
    producer = ReferenceProducer(options.folder)
    generator = np.random.default_rng()

    def show(cloud, _capture_ns):
        # While nobody watches, the robot takes nothing. The camera goes on, so that the next cloud is a recent one.
        wishes = producer.wait(timeout_s=0.01)
        if wishes is None:
            return
        bits_per_second, latency_test = wishes
        chosen = sample_points(cloud.reshape(-1, 4), bits_per_second or 30e6, options.fps, generator)
        producer.publish(pack_points(chosen, latency_test))

    return show


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
