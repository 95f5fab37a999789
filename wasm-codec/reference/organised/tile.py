"""Section "Tiles", and kind, pattern and mask of "A tile's symbols"."""
from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import List, Tuple

from .colour_blocks import Block
from .entropy_decoder import EntropyDecoder
from .stream_header import TILE_SIZE
from .tables import KIND, MASK, PATTERN, ContextSet

EMPTY, FULL, MIXED = 0, 1, 2
KIND_UNKNOWN = 3
PATTERN_UNKNOWN = 8

Mask = List[List[int]]  # by row and kept pixel, 1 where the pixel is valid


@dataclass
class Tile:
    """A tile that is not empty, as its symbols say it."""
    number: int
    pattern: int
    mask: Mask
    pixels: List[List[Tuple[int, int]]]  # u, v in the image by row and kept pixel
    depths: List[List[int]] = field(default_factory=list)
    indices: List[List[int]] = field(default_factory=list)  # mode 3, from 1
    blocks: List[Block] = field(default_factory=list)  # modes 1 and 2, patterns 0–2
    point_levels: List[Tuple[int, int, int]] = field(default_factory=list)  # modes 1 and 2, patterns 3–7

    def valid_pixels(self) -> List[Tuple[int, int]]:
        """x, y of the valid kept pixels, row by row."""
        return [(x, y) for y, row in enumerate(self.mask) for x, valid in enumerate(row) if valid]


def kept_pixels(pattern: int, left: int, top: int) -> List[List[Tuple[int, int]]]:
    """u, v of the pixels that a tile of this pattern keeps; left and top are its upper left pixel's."""
    step = 1 << (pattern >> 1)
    rows = []
    for y in range(TILE_SIZE // step):
        if pattern % 2 == 0:
            columns = range(0, TILE_SIZE, step)
        else:
            columns = range(step if y % 2 else 0, TILE_SIZE, 2 * step)
        rows.append([(left + column, top + y * step) for column in columns])
    return rows


def read_kind(decoder: EntropyDecoder, contexts: ContextSet, left_kind: int) -> int:
    return min(decoder.symbol(contexts[KIND + left_kind]), MIXED)


def read_pattern(decoder: EntropyDecoder, contexts: ContextSet, last_pattern: int) -> int:
    return decoder.symbol(contexts[PATTERN + last_pattern]) & 7


@lru_cache(maxsize=None)
def mask_order(height: int, groups: int) -> List[Tuple[int, int]]:
    """x, y of the groups of four pixels: by their time, at the same time the lower x first."""
    return sorted(((x, y) for y in range(height) for x in range(groups)),
                  key=lambda group: (group[0] + 2 * group[1], group[0]))


def read_mask(decoder: EntropyDecoder, contexts: ContextSet, width: int, height: int) -> Mask:
    mask = [[0] * width for _ in range(height)]
    for x, y in mask_order(height, (width + 3) // 4):
        first = 4 * x
        row = mask[y]
        above = mask[y - 1] if y else [1] * width
        four_above = sum(valid << i for i, valid in enumerate(above[first:first + 4]))
        left = row[first - 1] if x else above[0]
        above_right = above[min(first + 4, width - 1)]
        symbol = decoder.symbol(contexts[MASK + 4 * four_above + 2 * left + above_right])
        for i in range(first, min(first + 4, width)):
            row[i] = symbol >> (i - first) & 1
    return mask
