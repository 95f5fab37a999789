"""Farpoint shared memory for what moves the wheels: reads the velocities that the robot writes with --sink shm.

The standard library only; Linux. The layout is specified in docs/shared-memory.md. The velocity is zero unless the robot is
alive: when it is silent for longer than a given time, was killed, or has left a stale or half-written file.

    reader = VelocityReader(silence_s=0.2, answers=True)
    while True:                                 # at the rate of the motors, at least 20 times a second
        velocity = reader.read()                # zero unless velocity.state is FRESH
        wheels.drive(velocity.linear[0], velocity.angular[2])
        reader.answer()
        time.sleep(0.02)

This program can hang or be killed, too: let the motors' controller stop by itself when it gets nothing new.
"""
import math
import os
import stat
import struct
import threading
import time
from typing import NamedTuple, Tuple

DEFAULT_FOLDER = "/dev/shm"

# Why the velocity is what it is. It is zero unless it is fresh.
FRESH = "fresh"
UNHEARD = "unheard"  # the file has not changed since it was opened: it may be left from an earlier run
SILENT = "silent"  # nothing complete was written for silence_s
ABSENT = "absent"  # there are no such files, or they are refused: reader.fault says why
INVALID = "invalid"  # a velocity that is not finite

_BLOCK_BYTES = 52
_BUSY_BYTES = 5
_ECHO_OFFSET = 1
# The robot writes every 40 ms: a shorter time would stop it for nothing.
_LEAST_SILENCE_S, _MOST_SILENCE_S = 0.1, 5.0
_STILL = (0.0, 0.0, 0.0)


class Velocity(NamedTuple):
    state: str
    linear: Tuple[float, float, float]  # x forward, y to the left, z up; m/s
    angular: Tuple[float, float, float]  # about the same axes; rad/s


def _boot_s():
    """Also counts while the machine sleeps: what was written before is no longer fresh after."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


class VelocityReader:
    """Reads the command block. It belongs to one thread, and nothing that happens to the files raises an exception.

    silence_s: the wheels stop after this long without a write, 0.1 to 5.
    answers: whether `answer` will be called, for which this program must be permitted to write semaphore_ros_read.
    owner: id of the robot's user, if it is neither this program's nor root: whoever owns the files can move the robot.
    now: a clock that does not step back, in seconds.
    """

    def __init__(self, folder=DEFAULT_FOLDER, silence_s=0.2, answers=False, owner=None, now=_boot_s):
        if not _LEAST_SILENCE_S <= silence_s <= _MOST_SILENCE_S:
            raise ValueError(f"silence_s {silence_s}, not {_LEAST_SILENCE_S} to {_MOST_SILENCE_S}")
        self.fault = None
        self._block_path = os.path.join(folder, "shared_control")
        self._busy_path = os.path.join(folder, "semaphore_ros_read")
        self._silence_s, self._answers, self._now = silence_s, answers, now
        self._owners = {os.geteuid(), 0, owner}
        self._lock = threading.Lock()
        self._block = self._busy = None
        self._looked_s = -math.inf
        self._forget()

    def read(self):
        """The velocity for the wheels now; zero unless its state is FRESH. Call it at least 20 times a second."""
        now_s = self._now()
        fault = self._find()
        if fault is not None:
            self.fault = fault
            return Velocity(ABSENT, _STILL, _STILL)
        self.fault = None
        # A write takes less than a microsecond.
        for _ in range(3):
            block = self._copy()
            if block is not None:
                self._take(block, now_s)
                break
        was_absent = now_s - self._looked_s > self._silence_s
        self._looked_s = now_s
        if not self._is_heard:
            return Velocity(UNHEARD, _STILL, _STILL)
        if was_absent or now_s - self._changed_s > self._silence_s:
            return Velocity(SILENT, _STILL, _STILL)
        if not all(map(math.isfinite, self._values)):
            return Velocity(INVALID, _STILL, _STILL)
        return Velocity(FRESH, self._values[:3], self._values[3:])

    def answer(self):
        """Tells the robot that the wheels have been given the velocity that was read last; whether it was told.

        A robot that was answered once stops when the answers end.
        """
        if not self._answers:
            raise ValueError("this reader was opened without answers=True")
        if not self._is_heard or not _is_current(self._busy, _BUSY_BYTES):
            return False
        try:
            return os.pwrite(self._busy, bytes([self._counter & 0xFF]), _ECHO_OFFSET) == 1
        except OSError:
            return False

    def close(self):
        self._forget()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _forget(self):
        for fd in (self._block, self._busy):
            if fd is not None:
                os.close(fd)
        self._block = self._busy = None
        self._counter, self._is_heard, self._changed_s, self._values = None, False, -math.inf, (*_STILL, *_STILL)

    def _find(self):
        """Opens the files, again if they were replaced; why that is impossible."""
        if _is_current(self._block, _BLOCK_BYTES) and _is_current(self._busy, _BUSY_BYTES):
            return None
        self._forget()
        try:
            self._block = self._open(self._block_path, os.O_RDONLY, _BLOCK_BYTES)
            self._busy = self._open(self._busy_path, os.O_RDWR if self._answers else os.O_RDONLY, _BUSY_BYTES)
        except OSError as error:
            self._forget()
            return error.strerror if error.filename is None else f"{error.filename}: {error.strerror}"
        return None

    def _open(self, path, access, size):
        """A file with exactly this size that is not a link, and that nobody but the right users can write."""
        fd = os.open(path, access | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
        status = os.fstat(fd)
        fault = None
        if not stat.S_ISREG(status.st_mode):
            fault = "it is not a regular file"
        elif status.st_mode & stat.S_IWOTH:
            fault = "everybody may write it: chmod o-w it"
        elif status.st_uid not in self._owners:
            fault = f"another user ({status.st_uid}) made it: name it as owner, or remove the file"
        elif status.st_size != size:
            fault = f"it has {status.st_size} bytes, not {size}"
        if fault is None:
            return fd
        os.close(fd)
        raise OSError(None, fault, path)

    def _copy(self):
        """The block, or None while it is being written. Files are read, not mapped: nothing can fault."""
        try:
            if os.pread(self._busy, 1, 0) != b"\0":
                return None
            self._barrier()
            block = os.pread(self._block, _BLOCK_BYTES, 0)
            self._barrier()
            if os.pread(self._busy, 1, 0) != b"\0":
                return None
            self._barrier()
            # A complete write may have happened meanwhile, which changes the counter.
            again = os.pread(self._block, 4, 0)
        except OSError:
            return None
        return block if len(block) == _BLOCK_BYTES and again == block[:4] else None

    def _take(self, block, now_s):
        counter, *values = struct.unpack("<I6d", block)
        if counter == self._counter:
            return
        # What the files held before this program looked, or while it did not, may be old.
        self._is_heard = self._counter is not None and now_s - self._looked_s <= self._silence_s
        if self._is_heard:
            self._changed_s = now_s
        self._counter, self._values = counter, tuple(values)

    def _barrier(self):
        """A memory barrier: acquiring and releasing a lock twice is one on every machine that Python runs on."""
        with self._lock:
            pass
        with self._lock:
            pass


def _is_current(fd, size):
    """Whether the file still has a name and its size."""
    if fd is None:
        return False
    status = os.fstat(fd)
    return status.st_nlink > 0 and status.st_size == size
