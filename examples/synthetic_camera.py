#!/usr/bin/env python3
"""A synthetic camera: a moving scene as a depth camera would see it, through shared memory.

    python3 examples/synthetic_camera.py [--layout farpoint|reference] [--format points|depth16|depth32]
                                         [--size 480] [--fps 30] [--folder /dev/shm] [--frames N]

Start the robot with `--source shm` (and `--shm-layout reference`). Ctrl-C ends it.
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

WALL_M, FLOOR_M, BALL_M = 4.0, 1.2, 0.35


class Scene:
    """A wall, a floor, and a ball that swings in front of them. The camera looks along z, with x right and y down."""

    def __init__(self, size):
        focal = 0.6 * size
        self.lens = (focal, focal, (size - 1) / 2, (size - 1) / 2)
        v, u = np.mgrid[0:size, 0:size].astype(np.float32)
        self.rays = np.stack([(u - self.lens[2]) / focal, (v - self.lens[3]) / focal, np.ones_like(u)], axis=-1)
        with np.errstate(divide="ignore"):
            floor = np.where(self.rays[..., 1] > 0, FLOOR_M / self.rays[..., 1], np.inf)
        self.background = np.minimum(floor, WALL_M).astype(np.float32)
        tiles = np.floor(self.rays * self.background[..., None] * 2).astype(int).sum(axis=-1) % 2
        grey = np.where(tiles == 0, 90, 160).astype(np.uint8)
        self.paint = np.stack([grey, grey, np.where(floor < WALL_M, grey, 200).astype(np.uint8), np.full_like(grey, 255)], -1)

    def at(self, seconds):
        """Depth in metres and R, G, B, A of each pixel."""
        centre = np.array([1.2 * np.sin(seconds), 0.3 * np.sin(2.3 * seconds), 2.2 + 0.6 * np.cos(seconds)], np.float32)
        a = (self.rays**2).sum(axis=-1)
        b = self.rays @ centre
        inside = b * b - a * (centre @ centre - BALL_M**2)
        with np.errstate(invalid="ignore"):
            ball = np.where(inside >= 0, (b - np.sqrt(inside)) / a, np.inf)
        depth = np.minimum(self.background, ball).astype(np.float32)
        colours = self.paint.copy()
        colours[ball < self.background] = (230, 80, 40, 255)
        return depth, colours

    def points(self, depth, colours):
        """Shape (height, width, 4): x, y, z in metres, then the bytes of the colour."""
        points = np.empty((*depth.shape, 4), np.float32)
        points[..., :3] = self.rays * depth[..., None]
        points.view(np.uint8).reshape(*depth.shape, 16)[..., 12:] = colours
        return points


def main():
    parser = argparse.ArgumentParser(description="A moving scene through shared memory, without a camera.")
    parser.add_argument("--layout", choices=["farpoint", "reference"], default="farpoint")
    parser.add_argument("--format", choices=["points", "depth16", "depth32"], default="points")
    parser.add_argument("--size", type=int, default=480, help="width and height, pixels")
    parser.add_argument("--fps", type=float, default=30.0)
    parser.add_argument("--folder", default="/dev/shm")
    parser.add_argument("--frames", type=int, default=0, help="end after this many frames; 0: never")
    options = parser.parse_args()
    scene = Scene(options.size)
    show = reference_output(scene, options) if options.layout == "reference" else farpoint_output(scene, options)
    began = due = time.monotonic()
    shown = 0
    while options.frames == 0 or shown < options.frames:
        show(time.monotonic() - began)
        shown += 1
        due = max(due + 1 / options.fps, time.monotonic())
        time.sleep(max(0.0, due - time.monotonic()))


def farpoint_output(scene, options):
    producer = CloudProducer(options.size, options.size, options.format, options.fps, options.folder)

    def show(seconds):
        capture_ns = time.monotonic_ns()
        depth, colours = scene.at(seconds)
        room = producer.begin()
        if options.format == "points":
            # Copied as words: a colour's bits may be those of a NaN.
            room.view(np.uint32)[...] = scene.points(depth, colours).view(np.uint32)
        else:
            room[0][...] = depth * 1000 if options.format == "depth16" else depth
            room[1][...] = colours
        producer.publish(capture_ns, lens=scene.lens)

    return show


def reference_output(scene, options):
    producer = ReferenceProducer(options.folder)
    generator = np.random.default_rng(1)

    def show(seconds):
        bits_per_second, latency_test = producer.wait()
        cloud = scene.points(*scene.at(seconds)).reshape(-1, 4)
        chosen = sample_points(cloud, bits_per_second or 30e6, options.fps, generator)
        producer.publish(pack_points(chosen, latency_test))

    return show


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
