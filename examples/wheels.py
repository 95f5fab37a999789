#!/usr/bin/env python3
"""Wheels without motors: reads the robot's velocities from shared memory and says what the wheels would do.

    python3 examples/wheels.py [--folder /dev/shm] [--silence-ms 200] [--owner UID]

Start the robot with `--sink shm`. Put your motors' controller in the place of `drive`. Ctrl-C ends it.
"""
import argparse
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "packages", "shared-memory", "python"))
from farpoint_velocity import VelocityReader  # noqa: E402

PERIOD_S = 0.02


class Wheels:
    """Says each new velocity, in a line of its own."""

    def __init__(self):
        self._said = None

    def drive(self, forward, turn, state):
        line = f"{state} {forward:.3f} m/s {turn:.3f} rad/s"
        if line != self._said:
            print(line, flush=True)
        self._said = line


def main():
    parser = argparse.ArgumentParser(description="Says what the wheels would do.")
    parser.add_argument("--folder", default="/dev/shm")
    parser.add_argument("--silence-ms", type=float, default=200.0, help="stop after this long without a write")
    parser.add_argument("--owner", type=int, help="id of the robot's user, if it is another one")
    options = parser.parse_args()
    wheels = Wheels()
    with VelocityReader(options.folder, options.silence_ms / 1000, answers=True, owner=options.owner) as reader:
        while True:
            velocity = reader.read()
            wheels.drive(velocity.linear[0], velocity.angular[2], velocity.state)
            reader.answer()
            time.sleep(PERIOD_S)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
