"""Section "From symbols to points", Colour."""
from __future__ import annotations

from typing import List, Tuple

from .arithmetic import clamp, limit16
from .block_transform import inverse_transform
from .colour_blocks import BLOCK, PLANES
from .tile import Tile

Colour = Tuple[int, int, int]  # R, G, B

PURE_GREEN = (0, 255, 0)
STEPS = (32, 37, 42, 49, 56, 64, 74, 84, 97, 111, 128, 147, 169, 194, 223, 256, 294, 338, 388, 446, 512,
         588, 676, 776, 891, 1024, 1176, 1351, 1552, 1783, 2048, 2353)  # S, by quality; in 1/16


def to_rgb(Y: int, Co: int, Cg: int) -> Colour:
    """All three are four times their value."""
    y = limit16(Y + 514)
    without_green = limit16(y - Cg)
    sums = (limit16(without_green + Co), limit16(y + Cg), limit16(without_green - Co))
    r, g, b = (clamp(total >> 2, 0, 255) for total in sums)
    return r, g, b


def to_16_bits(colour: Colour) -> int:
    r, g, b = colour
    return r >> 2 << 10 | g >> 2 << 4 | b >> 4


def point_colours(tile: Tile, quality: int) -> List[Colour]:
    """Of patterns 3–7, in the order of the valid pixels."""
    step = max(16, 3 * STEPS[quality] // 4)
    return [to_rgb(*(level * step >> 2 for level in levels)) for levels in tile.point_levels]


def block_colours(tile: Tile, quality: int, half_chroma: bool) -> List[Colour]:
    """Of patterns 0–2, in the order of the valid pixels."""
    S = STEPS[quality]
    steps = (S, 13 * S // 16, 11 * S // 16) if half_chroma else (S, 20 * S // 16, S)
    height, width = len(tile.mask), len(tile.mask[0])
    planes = [[[0] * width for _ in range(height)] for _ in range(PLANES)]
    for block in tile.blocks:
        values = inverse_transform([block.head.dc, *block.levels], steps[block.plane])
        for y, row in enumerate(values, start=BLOCK * block.row):
            planes[block.plane][y][BLOCK * block.column:BLOCK * (block.column + 1)] = row
    # A subsampled chroma value serves all its pixels: the one block covers the tile.
    x_share, y_share = (width // BLOCK, height // BLOCK) if half_chroma else (1, 1)
    Y, Co, Cg = planes
    return [to_rgb(Y[y][x], Co[y // y_share][x // x_share], Cg[y // y_share][x // x_share])
            for x, y in tile.valid_pixels()]
