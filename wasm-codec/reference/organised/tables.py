"""Frequencies of the entropy coder's contexts: section "Entropy coder", Tables."""
from __future__ import annotations

import struct
from itertools import accumulate
from pathlib import Path
from typing import List, NamedTuple, Tuple

SYMBOLS = 16
TOTAL = 512
CONTEXT_BYTES = 2 * SYMBOLS

GEOMETRY_SETS, GEOMETRY_CONTEXTS = 8, 122
KIND, PATTERN, MASK, DEPTH, ANCHOR = 0, 4, 13, 77, 121
PLANE_CONTEXTS = 44  # from DEPTH, and those of palette indices

# A colour set's last contexts are for palette indices, which always use the stream header's instead.
COLOUR_SETS, COLOUR_CONTEXTS = 4, 170
DC, LAST, LEAD, COEFFICIENT, POINT = 0, 6, 18, 34, 114


class Context(NamedTuple):
    frequencies: Tuple[int, ...]
    starts: Tuple[int, ...]  # the running sums of the frequencies, from 0


ContextSet = List[Context]


class Tables(NamedTuple):
    geometry: List[ContextSet]
    colour: List[ContextSet]


def read_contexts(data: bytes) -> ContextSet:
    contexts = []
    for offset in range(0, len(data), CONTEXT_BYTES):
        frequencies = struct.unpack_from('<16H', data, offset)
        if sum(frequencies) != TOTAL:
            raise ValueError(f'the frequencies of context {offset // CONTEXT_BYTES} do not add up to {TOTAL}')
        contexts.append(Context(frequencies, (0, *accumulate(frequencies[:-1]))))
    return contexts


def load_tables(path: Path) -> Tables:
    """Reads tables.bin: the geometry sets, then the colour sets."""
    data = path.read_bytes()
    geometry_end = GEOMETRY_SETS * GEOMETRY_CONTEXTS
    end = geometry_end + COLOUR_SETS * COLOUR_CONTEXTS
    if len(data) != end * CONTEXT_BYTES:
        raise ValueError(f'{path} has {len(data)} bytes, not {end * CONTEXT_BYTES}')
    contexts = read_contexts(data)
    return Tables(
        [contexts[i:i + GEOMETRY_CONTEXTS] for i in range(0, geometry_end, GEOMETRY_CONTEXTS)],
        [contexts[i:i + COLOUR_CONTEXTS] for i in range(geometry_end, end, COLOUR_CONTEXTS)])
