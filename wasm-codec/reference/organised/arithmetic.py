"""The few operations on numbers that all sections of the specification share."""
from __future__ import annotations

import struct
from binascii import crc_hqx
from bisect import bisect_left
from typing import Sequence


def clamp(value: int, lowest: int, highest: int) -> int:
    return max(lowest, min(highest, value))


def wrap16(value: int) -> int:
    """The lowest 16 bits, as a signed number."""
    return ((value + 0x8000) & 0xFFFF) - 0x8000


def limit16(value: int) -> int:
    """Limited to the range of a signed number of 16 bits."""
    return clamp(value, -0x8000, 0x7FFF)


def unfold(n: int) -> int:
    """0, 1, 2, 3 … become 0, −1, 1, −2 …."""
    return -((n + 1) >> 1) if n & 1 else n >> 1


def bin_of(value: int, last_of_bins: Sequence[int]) -> int:
    """The bin of a value, where each bin but the last is given by the largest value in it."""
    return bisect_left(last_of_bins, value)


def f32(value: float) -> float:
    """Rounds to f32. One operation of f32 is the same one in f64, then rounded."""
    rounded: float = struct.unpack('<f', struct.pack('<f', value))[0]
    return rounded


def crc16(data: bytes) -> int:
    """CRC-16/CCITT-FALSE: polynomial 0x1021, first 0xFFFF; crc_hqx is that CRC."""
    return crc_hqx(data, 0xFFFF)
