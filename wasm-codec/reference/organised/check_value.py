"""Section "Check value of modes 0 and 3"."""
from __future__ import annotations

import struct
from typing import List, Sequence

from .arithmetic import wrap16
from .tile import Tile

LANES = 16
INDEX_FACTOR = 0x2B85


class CheckValue:
    def __init__(self) -> None:
        self._lanes = [0] * LANES

    def _take(self, values: Sequence[int]) -> None:
        for i, value in enumerate(values):
            h = wrap16(0x6A4D * (self._lanes[i] ^ wrap16(value)))
            self._lanes[i] = h ^ h >> 7

    def add_tile(self, tile: Tile) -> None:
        self._take([tile.number] * 8 + [tile.pattern] * 8)
        self._take(padded([sum(valid << x for x, valid in enumerate(row)) for row in tile.mask]))
        for y, row in enumerate(tile.mask):
            values = list(tile.depths[y])
            if tile.indices:
                values = [q + INDEX_FACTOR * index for q, index in zip(values, tile.indices[y])]
            self._take(padded([value if valid else 0 for value, valid in zip(values, row)]))

    def finish(self, first_two_bytes: bytes, first_tile: int, tiles: int) -> int:
        """The 60 bits, once all tiles have been added."""
        self._take([int.from_bytes(first_two_bytes, 'little')] * 8 + [first_tile] * 8)
        self._take([tiles] * LANES)
        fnv = 0xCBF29CE484222325
        for byte in struct.pack('<16h', *self._lanes):
            fnv = (fnv ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
        return fnv >> 4


def padded(values: List[int]) -> List[int]:
    return values + [0] * (LANES - len(values))
