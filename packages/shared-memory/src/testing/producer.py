"""Writes what src/producers.stack.test.ts expects: `producer.py FOLDER points|depth16|depth32|reference|refusals|pack`."""
import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
from farpoint_shm import CloudProducer, ReferenceProducer, SharedMemoryError, pack_points, sample_points  # noqa: E402

LENS = (2, 2, 1, 1)


def clouds(folder, format):
    producer = CloudProducer(4, 3, format, 30, folder, 0o660)
    pixels = np.arange(12).reshape(3, 4)
    rgba = np.stack([pixels, pixels + 1, pixels + 2, np.full_like(pixels, 255)], -1).astype(np.uint8)
    lens = None if format == "points" else LENS
    for number in range(1, 7):
        room = producer.begin()
        if format == "points":
            room[..., :3] = (pixels + number)[..., None]
            room.view(np.uint8).reshape(3, 4, 16)[..., 12:] = rgba
        else:
            room[0][...] = (pixels + number) * (1000 if format == "depth16" else 1)
            room[1][...] = rgba
        producer.publish(123456789, (1.5, 0, 0), (0, 0, 0, 1), lens, latency_test=True)
    # Begun and not published: must not be visible.
    producer.begin()
    producer.close()


def refused(error, action):
    try:
        action()
    except error:
        return
    sys.exit("it was accepted")


def refusals(folder):
    producer = CloudProducer(4, 3, "depth16", folder=folder)
    refused(SharedMemoryError, lambda: CloudProducer(4, 3, folder=folder))
    refused(ValueError, lambda: CloudProducer(4096, 4096, folder=folder))
    refused(ValueError, lambda: CloudProducer(4, 3, "voxels", folder=folder))
    producer.begin()
    refused(ValueError, lambda: producer.publish())
    refused(ValueError, lambda: producer.publish(lens=(0, 1, 1, 1)))
    refused(ValueError, lambda: producer.publish(lens=LENS, position=(0, 0, 0)))
    refused(ValueError, lambda: producer.publish(lens=LENS, position=(0, 0, 0), orientation=(0, 0, 0, 0.5)))
    os.unlink(os.path.join(folder, "farpoint_cloud"))
    refused(SharedMemoryError, lambda: producer.publish(lens=LENS))


def reference(folder):
    producer = ReferenceProducer(folder)
    bits_per_second, latency_test = producer.wait(5)
    refused(ValueError, lambda: producer.publish(np.ones(1207, np.uint8)))
    producer.publish(np.ones(1208, np.uint8))
    assert producer.wait(0.001) is None
    print(bits_per_second, int(latency_test))


def pack(_folder):
    """From JSON on standard input: points as [x, y, z, R, G, B]."""
    given = json.load(sys.stdin)
    points = np.zeros((len(given), 4), np.float32)
    for i, point in enumerate(given):
        points[i, :3] = [np.nan if c is None else c for c in point[:3]]
        points.view(np.uint8).reshape(-1, 16)[i, 12:15] = point[3:]
    chosen = sample_points(np.repeat(points[:1], 2000, axis=0), 64 * 300 * 10, 10, np.random.default_rng(1))
    print(json.dumps({"hex": pack_points(points).tobytes().hex(), "green": pack_points(points, True).tobytes().hex(), "drawn": len(chosen)}))


folder, what = sys.argv[1:]
if what in ("points", "depth16", "depth32"):
    clouds(folder, what)
else:
    {"reference": reference, "refusals": refusals, "pack": pack}[what](folder)
