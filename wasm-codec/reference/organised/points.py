"""Section "From symbols to points", Depth and Points."""
from __future__ import annotations

from typing import List, NamedTuple

from .arithmetic import f32
from .colours import Colour, to_16_bits
from .stream_header import StreamHeader
from .tile import Tile


class Point(NamedTuple):
    x: int  # mm, as y and z
    y: int
    z: int
    colour: int  # 6 bits of R, 6 of G, 4 of B, R highest


def tile_points(header: StreamHeader, depth_level: int, tile: Tile, colours: List[Colour]) -> List[Point]:
    """A tile's points; the colours are its valid pixels'."""
    s = f32(1 / f32(header.depth_unit * (1 << depth_level)))
    points = []
    for (x, y), colour in zip(tile.valid_pixels(), colours):
        u, v = tile.pixels[y][x]
        z = f32(s / tile.depths[y][x])
        X = f32((u - header.cx) / header.fx)
        Y = f32((v - header.cy) / header.fy)
        points.append(Point(millimetres(f32(z * X)), millimetres(f32(z * Y)), millimetres(z),
                            to_16_bits(colour)))
    return points


def millimetres(metres: float) -> int:
    """Rounded to the nearest, of two to the even, as round() does."""
    return round(max(-32767.0, min(32767.0, f32(metres * 1000))))
