"""Reads velocities when it is told to, at the times that it is told: `velocity_reader.py FOLDER SILENCE_MS`."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
from farpoint_velocity import VelocityReader  # noqa: E402

now_s = 0.0
try:
    reader = VelocityReader(sys.argv[1], float(sys.argv[2]) / 1000, answers=True, now=lambda: now_s)
except ValueError:
    print("refused")
    sys.exit()
print("ready", flush=True)
for line in sys.stdin:
    if line.startswith("answer"):
        print("told" if reader.answer() else "not told", flush=True)
    else:
        now_s = int(line) / 1000
        velocity = reader.read()
        print(velocity.state, *(f"{value:.17g}" for value in (*velocity.linear, *velocity.angular)), flush=True)
reader.close()
