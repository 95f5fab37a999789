"""Farpoint shared memory for producers: a depth camera's program gives its frames to the robot.

numpy and the standard library; Linux. The layouts are specified in docs/shared-memory.md. A producer may be killed at any
instant: readers never see half a frame, and the next producer takes over.

    producer = CloudProducer(width=480, height=480, frames_per_second=30)
    while True:
        points = producer.begin()          # float32, shape (480, 480, 4); the fourth value's bytes are R, G, B, A
        points[...] = cloud
        producer.publish(capture_ns=time.monotonic_ns())
"""
import ctypes
import fcntl
import math
import mmap
import os
import platform
import stat
import struct
import threading
import time

import numpy as np

DEFAULT_FOLDER = "/dev/shm"

_HEADER_BYTES = 4096
_SLOT_HEADER_BYTES = 128
_PUBLISHED_OFFSET = 64
_SLOTS = 4
_FORMATS = {"points": 1, "depth16": 2, "depth32": 3}
_HAS_POSE, _HAS_LENS, _IS_LATENCY_TEST = 1, 2, 4
MAX_POINTS = 4_194_304

REFERENCE_MAX_POINTS = 230_400
REFERENCE_BLOCK = 150
LATENCY_TEST_COLOUR = 0x03F0


class SharedMemoryError(Exception):
    """An invalid file, or one that another producer uses."""


def _open(path, size, mode, exclusive):
    """Opens or creates a file with exactly `size` bytes that is not a link and not writable by everybody."""
    flags = os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK
    fd = None
    if not exclusive:
        try:
            fd = os.open(path, flags)
        except FileNotFoundError:
            pass
    try:
        if fd is None:
            fd = os.open(path, flags | os.O_CREAT | os.O_EXCL, mode)
            os.fchmod(fd, mode)
        status = os.fstat(fd)
        if not stat.S_ISREG(status.st_mode):
            raise SharedMemoryError(f"{path}: it is not a regular file")
        if status.st_mode & stat.S_IWOTH:
            raise SharedMemoryError(f"{path}: everybody may write it: chmod o-w it")
        if status.st_size != size:
            os.ftruncate(fd, size)
        return fd, mmap.mmap(fd, size, mmap.MAP_SHARED, mmap.PROT_READ | mmap.PROT_WRITE)
    except BaseException:
        if fd is not None:
            os.close(fd)
        raise


class _Barrier:
    """A memory barrier: acquiring and releasing a lock twice is one on every machine that Python runs on."""

    def __init__(self):
        self._lock = threading.Lock()

    def __call__(self):
        with self._lock:
            pass
        with self._lock:
            pass


class _Futex:
    """Wakes readers that wait for a word."""

    _NUMBERS = {"x86_64": 202, "aarch64": 98, "armv7l": 240, "riscv64": 98}

    def __init__(self):
        machine = platform.machine()
        if machine not in self._NUMBERS:
            raise SharedMemoryError(f"the number of the futex call on {machine} is not known here")
        self._number = ctypes.c_long(self._NUMBERS[machine])
        self._syscall = ctypes.CDLL(None, use_errno=True).syscall

    def wake(self, address):
        everybody, futex_wake = 0x7FFFFFFF, 1
        self._syscall(self._number, ctypes.c_void_p(address), futex_wake, everybody, None, None, 0)


def _align64(size):
    return (size + 63) // 64 * 64


class CloudProducer:
    """Writes frames in Farpoint's own layout. The newest frame wins; readers never block the producer.

    format: "points" (float32 x, y, z in metres in the optical frame: x right, y down, z forward; then R, G, B, A),
    "depth16" (uint16 in units of `depth_unit` metres, 0 if none was measured) or "depth32" (float32 metres), both
    with separate colours. Raises SharedMemoryError while another producer is running.
    """

    def __init__(self, width, height, format="points", frames_per_second=0.0, folder=DEFAULT_FOLDER, mode=0o600):
        if format not in _FORMATS:
            raise ValueError(f"format {format!r}, not one of {', '.join(_FORMATS)}")
        points = width * height
        if not (width >= 1 and height >= 1 and points <= MAX_POINTS):
            raise ValueError(f"{width} × {height} points, {MAX_POINTS} are the most")
        if not 0 <= frames_per_second <= 1000:
            raise ValueError(f"{frames_per_second} frames a second")
        self.width, self.height, self.format = width, height, format
        self._frame = 0
        self._barrier, self._futex = _Barrier(), _Futex()
        depth_bytes = {"points": 16, "depth16": 2, "depth32": 4}[format]
        self._colour_offset = _align64(points * depth_bytes)
        payload = points * 16 if format == "points" else self._colour_offset + points * 4
        self._slot_bytes = _align64(_SLOT_HEADER_BYTES + payload)
        self._size = _HEADER_BYTES + _SLOTS * self._slot_bytes
        path = os.path.join(folder, "farpoint_cloud")
        former = self._lock_former(path)
        try:
            self._make(path, frames_per_second, mode & 0o660)
        finally:
            if former is not None:
                os.close(former)
        self._words = np.frombuffer(self._map, dtype="<u4")
        self._published_address = self._words.ctypes.data + _PUBLISHED_OFFSET

    def begin(self):
        """Returns where the next frame goes.

        For points: float32 of shape (height, width, 4). For depth a pair: uint16 or float32 of shape (height,
        width), and uint8 of shape (height, width, 4) for R, G, B, A. Until it is published, readers see the previous
        frame. If a frame is begun and not published, the next call begins it again.
        """
        slot = self._slot()
        frame = self._frame + 1 & 0xFFFFFFFF
        self._words[slot // 4] = frame * 2 - 1 & 0xFFFFFFFF
        # No byte of the frame may become visible before the closed lock does.
        self._barrier()
        payload, points = slot + _SLOT_HEADER_BYTES, self.width * self.height
        shape = (self.height, self.width)
        if self.format == "points":
            return np.frombuffer(self._map, "<f4", points * 4, payload).reshape(*shape, 4)
        depth = np.frombuffer(self._map, "<u2" if self.format == "depth16" else "<f4", points, payload)
        colours = np.frombuffer(self._map, np.uint8, points * 4, payload + self._colour_offset)
        return depth.reshape(shape), colours.reshape(*shape, 4)

    def publish(self, capture_ns=0, position=None, orientation=None, lens=None, latency_test=False, depth_unit=0.001):
        """Publishes the frame that was begun.

        capture_ns: time.monotonic_ns() when the picture was taken; 0 if unknown.
        position, orientation: of the camera's optical frame in the world, metres and unit quaternion (x, y, z, w).
        lens: fx, fy, cx, cy in pixels; needed for depth. With it, points must lie on its rays.
        Raises SharedMemoryError if another producer has taken over.
        """
        header = self._frame_header(capture_ns, position, orientation, lens, latency_test, depth_unit)
        status = os.fstat(self._fd)
        if status.st_nlink == 0 or status.st_size != self._size:
            raise SharedMemoryError("another producer has taken over")
        slot, frame = self._slot(), self._frame + 1 & 0xFFFFFFFF
        self._map[slot + 4 : slot + _SLOT_HEADER_BYTES] = struct.pack("<I", frame) + header
        self._barrier()
        self._words[slot // 4] = frame * 2 & 0xFFFFFFFF
        self._barrier()
        self._words[_PUBLISHED_OFFSET // 4] = frame
        self._barrier()
        self._futex.wake(self._published_address)
        self._frame = frame

    def close(self):
        """Lets another producer start. The file stays until then."""
        if self._fd is not None:
            os.close(self._fd)
            self._fd = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _slot(self):
        return _HEADER_BYTES + (self._frame + 1 & 0xFFFFFFFF) % _SLOTS * self._slot_bytes

    def _frame_header(self, capture_ns, position, orientation, lens, latency_test, depth_unit):
        if (position is None) != (orientation is None):
            raise ValueError("a pose has both a position and an orientation")
        flags = _IS_LATENCY_TEST if latency_test else 0
        if position is not None:
            flags |= _HAS_POSE
            if not all(map(math.isfinite, position)):
                raise ValueError("a position that is not finite")
            if not abs(math.sqrt(sum(q * q for q in orientation)) - 1) < 0.01:
                raise ValueError("an orientation that is not a unit quaternion")
        if lens is not None:
            flags |= _HAS_LENS
            if not (all(map(math.isfinite, lens)) and lens[0] > 0 and lens[1] > 0):
                raise ValueError("impossible focal lengths or principal point")
        elif self.format != "points":
            raise ValueError("depth needs its lens: fx, fy, cx, cy")
        unit = depth_unit if self.format == "depth16" else 0.0
        if self.format == "depth16" and not 0 < unit <= 1:
            raise ValueError(f"{unit} metres a unit of depth")
        numbers = (*(position or (0, 0, 0)), *(orientation or (0, 0, 0, 0)), *(lens or (0, 0, 0, 0)))
        return struct.pack("<QIIII11dfI", capture_ns, self.width, self.height, flags, 0, *numbers, unit, 0)

    @staticmethod
    def _lock_former(path):
        try:
            former = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
        except OSError:
            return None
        try:
            fcntl.flock(former, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(former)
            raise SharedMemoryError(f"{path}: another producer is writing it") from None
        return former

    def _make(self, path, frames_per_second, mode):
        """Creates the file under a temporary name, then renames it."""
        unfinished = path + ".new"
        try:
            self._fd, self._map = _open(unfinished, self._size, mode, exclusive=True)
        except FileExistsError:
            # Left behind by a producer that was killed while it started.
            os.unlink(unfinished)
            self._fd, self._map = _open(unfinished, self._size, mode, exclusive=True)
        points = self.width * self.height
        fields = (1, _HEADER_BYTES, _FORMATS[self.format], _SLOTS, self._slot_bytes, points, frames_per_second, os.getpid())
        header = struct.pack("<8sIIIIIIfI", b"FARPOINT", *fields)
        self._map[: len(header)] = header
        fcntl.flock(self._fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.rename(unfinished, path)


class ReferenceProducer:
    """Writes frames in the reference system's layout: packed points, one frame at a time, taken by the robot."""

    def __init__(self, folder=DEFAULT_FOLDER, mode=0o600):
        size = 3 + REFERENCE_MAX_POINTS * 8
        self._cloud_fd, self._cloud = _open(os.path.join(folder, "shared_pc"), size, mode & 0o660, exclusive=False)
        self._flags_fd, self._flags = _open(os.path.join(folder, "semaphore_read"), 6, mode & 0o660, exclusive=False)
        self._barrier = _Barrier()

    def wait(self, timeout_s=math.inf):
        """Waits until the last frame was taken.

        Returns (the rate in bit/s that the frame should fit, whether it should be green), or None if it was not
        taken in time.
        """
        deadline = time.monotonic() + timeout_s
        while self._flags[0] != 0:
            if time.monotonic() >= deadline:
                return None
            time.sleep(0.0005)
        self._barrier()
        return struct.unpack("<I", self._flags[2:6])[0], self._flags[1] == 1

    def publish(self, packed):
        """Publishes a frame of packed points (see `pack_points`); only after `wait`."""
        packed = np.ascontiguousarray(packed).view(np.uint8).reshape(-1)
        if packed.size > REFERENCE_MAX_POINTS * 8 or packed.size % 8 != 0:
            raise ValueError(f"{packed.size} bytes cannot be a payload")
        self._cloud[0:3] = packed.size.to_bytes(3, "little")
        self._cloud[3 : 3 + packed.size] = packed.data
        self._barrier()
        self._flags[0] = 1

    def close(self):
        os.close(self._cloud_fd)
        os.close(self._flags_fd)


def pack_points(points, latency_test=False):
    """Packs points as the reference system sends them.

    points: float32 of shape (n, 4), metres and the bytes R, G, B, A; points that cannot be sent are left out.
    Returns uint8: blocks of 150 × (x, y, z as int16 millimetres), then 150 × colour of 6-6-4 bits; the last block
    may be shorter.
    """
    points = np.ascontiguousarray(points, dtype=np.float32).reshape(-1, 4)
    with np.errstate(invalid="ignore"):
        usable = np.isfinite(points[:, :3]).all(axis=1) & (points[:, 2] > 0) & (np.abs(points[:, :3]) <= 32.767).all(axis=1)
    points = points[usable]
    metres = points[:, :3].astype(np.float64)
    millimetres = (np.sign(metres) * np.floor(np.abs(metres) * 1000 + 0.5)).astype("<i2")
    rgba = points[:, 3].copy().view(np.uint8).reshape(-1, 4).astype(np.uint16)
    colours = (rgba[:, 0] >> 2 << 10 | rgba[:, 1] >> 2 << 4 | rgba[:, 2] >> 4).astype("<u2")
    if latency_test:
        colours[:] = LATENCY_TEST_COLOUR
    whole = len(points) // REFERENCE_BLOCK * REFERENCE_BLOCK
    blocks = np.empty((whole // REFERENCE_BLOCK, REFERENCE_BLOCK * 8), np.uint8)
    blocks[:, :900] = millimetres[:whole].reshape(-1, REFERENCE_BLOCK * 3).view(np.uint8)
    blocks[:, 900:] = colours[:whole].reshape(-1, REFERENCE_BLOCK).view(np.uint8)
    rest = [millimetres[whole:].reshape(-1).view(np.uint8), colours[whole:].view(np.uint8)]
    return np.concatenate([blocks.reshape(-1), *rest])


def sample_points(points, bits_per_second, frames_per_second, generator, power=1.0, near=3.85, floor=0.1):
    """Draws as many points as the rate carries, favouring near ones: the paper's equations 2 to 5.

    points: float32 of shape (n, 4); points without a depth are never drawn. power is λ, near is D in metres, floor
    the fraction of the cloud per second that is sent at any rate. Returns the drawn points in their original order.
    """
    points = np.ascontiguousarray(points, dtype=np.float32).reshape(-1, 4)
    total = len(points)
    most = max(min(bits_per_second / frames_per_second / 64, total), floor * total / frames_per_second)
    most = int(most // REFERENCE_BLOCK) * REFERENCE_BLOCK
    depth = points[:, 2].astype(np.float64)
    with np.errstate(invalid="ignore"):
        candidates = np.flatnonzero(np.isfinite(points[:, :3]).all(axis=1) & (depth > 0))
    if len(candidates) <= most:
        return points[candidates]
    depth = depth[candidates]
    weight = 1 / ((depth / depth.max()) ** power + 1e-6)
    weight[depth < near] = weight.max()
    # Exponential keys: the smallest values of E/w are a draw without replacement in proportion to w.
    keys = generator.exponential(size=len(candidates)) / weight
    return points[candidates[np.sort(np.argpartition(keys, most)[:most])]]
